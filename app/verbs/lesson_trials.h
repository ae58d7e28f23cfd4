// Runs a lesson one or more times with a simulated driver, judged by the same coach as the runs of a learner.
#pragma once

#include <optional>
#include <string>

#include "app/base/user_folders.h"
#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::verbs {

struct LessonTrials {
  lessons::LessonDriveConfig drive;         // configuration of the first run; the seed increases by 1 per run
  int runs = 1;                             // > 0: number of runs
  bool help = false;                        // use the coach's guidance policy instead of drive.guidance
  std::optional<lessons::LessonMode> mode;  // empty: the coach chooses
  std::string learner;                      // empty: nothing is saved
  base::HistoryLocation history;            // if it is unavailable, nothing is saved and the reason is reported
  std::string settings;                     // text that is saved with each run
  bool prints_shifts = false;               // print a line for each shift once it is saved
};

// Drives the runs and prints the coach's results. Problems with the history are printed to stderr, and the runs
// continue. Saved runs are recorded in recordings/ next to the history. Ctrl-C, SIGTERM and a closed terminal end the
// current run with a message on stderr. Returns true if all runs finished and the last one was passed. Throws like
// drive_lesson(), except for problems with automatic recordings.
bool drive_trials(const LessonTrials& trials);

}  // namespace gearshift::verbs
