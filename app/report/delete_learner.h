// A learner gone for good: rows and recordings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/history/history.h"

namespace gearshift {

struct Deleted {
  std::size_t sessions = 0, runs = 0, shifts = 0, faults = 0, comments = 0;
  std::vector<std::string> recordings;  // removed
  std::vector<std::string> missing;     // named by the history, and not found there
  std::vector<std::string> kept;        // named by the history, and not removed: "FILE: why"
  std::string left;                     // why the file still holds what was deleted, one sentence; empty: it does not
};

// A recording that another learner's run names stays. So does a file that is no trace: a history that somebody else
// wrote must not name what is removed. Throws HistoryError: then the learner is still there, and can be deleted again.
Deleted delete_learner(History& history, const LearnerRow& learner);

// Of a learner who is to be deleted the recordings alone, by the same rules: they need no room on the disk, and leave
// some to the rows.
Deleted remove_recordings(History& history, const LearnerRow& learner);

}  // namespace gearshift
