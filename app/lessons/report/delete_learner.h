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

// Keeps a recording that another learner's run references, and any file that is not a trace, because a forged history
// must not decide what is deleted. If HistoryError is thrown, the learner still exists and can be deleted again.
DeletionReport delete_learner(History& history, const LearnerRow& learner);

// Deletes only the recordings of a learner, by the same rules: this needs no disk space and frees some for the rows.
DeletionReport remove_recordings(History& history, const LearnerRow& learner);

}  // namespace gearshift::lessons
