// Runs a lesson one or more times with a simulated driver. The coach that judges learners also judges these runs.
#pragma once

#include <optional>
#include <string>

#include "app/base/user_folders.h"
#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::verbs {

struct LessonTrials {
  lessons::LessonDriveConfig drive;         // configuration of the first run; the seed increases by 1 per run
  int runs = 1;                             // number of runs, > 0
  bool help = false;                        // use the coach's guidance policy instead of drive.guidance
  std::optional<lessons::LessonMode> mode;  // empty: the coach chooses the mode
  std::string learner;                      // empty: nothing is saved
  base::HistoryLocation history;            // if this is unavailable, nothing is saved and the reason is reported
  std::string server;                       // address of the school's server; empty: none
  bool prints_shifts = false;               // print a line for each shift after the shift was saved
  bool json = false;                        // print one JSON document at the end instead of text
};

// Drives the runs and prints the coach's results. Problems with the history are printed to stderr and do not stop the
// runs. Each saved run is recorded in the folder recordings/ next to the history. Ctrl-C, SIGTERM or closing the
// terminal ends the current run and skips the remaining runs; a message is printed to stderr. Returns true if all runs
// finished and the last run was passed. Throws like drive_lesson(), except for problems with automatic recordings.
bool drive_trials(const LessonTrials& trials);

}  // namespace gearshift::verbs
