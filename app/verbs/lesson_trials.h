// Trials of a lesson by a simulated learner, one after another, through the same coach as a person's.
#pragma once

#include <optional>
#include <string>

#include "app/learner/lesson_drive.h"
#include "app/trainer/user_folder.h"

namespace gearshift {

struct LessonTrials {
  LessonDriveConfig drive;         // of the first; each next one has the next seed
  int runs = 1;                    // > 0
  bool help = false;               // guided as the coach's policy says, in place of drive.guidance
  std::optional<LessonMode> mode;  // else the coach's
  std::string learner;             // empty: nobody, nothing is remembered
  HistoryPlace history;            // none: nothing is remembered, and is told why
  std::string settings;            // for the history
  bool tells_shifts = false;       // a line for each, when it is written
};

// Prints what the coach says, and problems of the history as one sentence on stderr; the trials go on. What is
// remembered is recorded in the history's folder, below recordings/. Ctrl-C, kill and a closed terminal leave the lesson
// that is driven, in one sentence on stderr. Returns whether the last one was passed, and none was left for that. Throws
// as drive_lesson() does, but not for a recording that nobody asked for.
bool drive_trials(const LessonTrials& trials);

}  // namespace gearshift
