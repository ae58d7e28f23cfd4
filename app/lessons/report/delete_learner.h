// Deletes a learner: the rows in the history, and the recordings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct DeletionReport {
  std::size_t sessions = 0, runs = 0, shifts = 0, errors = 0, comments = 0;
  std::vector<std::string> recordings;   // deleted files
  std::vector<std::string> missing;      // referenced by the history but not found
  std::vector<std::string> not_deleted;  // referenced by the history but not deleted: "FILE: why"
  std::string remaining_data;            // one sentence on why the file still contains deleted data; else empty
};

// Deletes the learner's rows and recordings. Keeps a recording that another learner's run references. Also keeps any
// file that is not a trace, so that a forged history cannot delete other files. If HistoryError is thrown, the learner
// still exists, and the deletion can be repeated.
DeletionReport delete_learner(History& history, const LearnerRow& learner);

// Deletes only the learner's recordings, by the same rules. This needs no disk space, and frees some for deleting the
// rows.
DeletionReport remove_recordings(History& history, const LearnerRow& learner);

}  // namespace gearshift::lessons
