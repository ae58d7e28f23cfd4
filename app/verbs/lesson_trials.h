// Runs of a lesson by a simulated driver, one after another, judged by the same coach as a person's.
#pragma once

#include <optional>
#include <string>

#include "app/base/user_folders.h"
#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::verbs {

struct LessonTrials {
  lessons::LessonDriveConfig drive;         // of the first run; the seed increases by 1 per run
  int runs = 1;                             // > 0
  bool help = false;                        // use the coach's guidance policy instead of drive.guidance
  std::optional<lessons::LessonMode> mode;  // default: the coach's choice
  std::string learner;                      // empty: nothing is saved
  base::HistoryLocation history;            // if it is unavailable, nothing is saved and the reason is reported
  std::string settings;                     // saved with each run
  bool prints_shifts = false;               // print a line for each shift once it is saved
};

// Prints the coach's results. Problems with the history are printed to stderr and the runs continue. Saved runs are
// recorded in recordings/ beside the history. Ctrl-C, SIGTERM and a closed terminal end the current run with a message
// on stderr. Returns true if all runs finished and the last one was passed. Throws like drive_lesson(), except for
// automatic recordings.
bool drive_trials(const LessonTrials& trials);

}  // namespace gearshift::verbs
