// State of a learner's lessons as plain values, for the panel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/lessons/assessment/hint_style.h"
#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/assessment/mastery.h"
#include "app/lessons/history/history.h"

namespace gearshift::lessons {

enum class LessonPhase {
  none,
  offered,  // the goal is shown; the car waits
  driving,
  over  // the result is shown
};

// A lesson in the list of lessons, with the learner's results in this lesson.
struct LessonStanding {
  std::string key, title, task;
  int trials = 0;               // number of graded trials
  std::optional<double> grade;  // [1] 0 to 10, grade of the last graded trial
  bool passed = false;          // a graded trial was passed
  Mastery mastery = Mastery::not_passed;
  int tries = 0;                 // number of runs, also guided, incomplete and abandoned ones
  std::optional<double> best{};  // [1] 0 to 10, best grade of all graded trials
};

struct CoachView {
  // Learner
  std::string learner;                // empty: no learner; nothing is saved
  std::vector<std::string> learners;  // known learners, sorted by name
  bool is_saving = false;             // the history is open and the learner was not deleted
  bool learner_deleted = false;       // deleted by another program; nothing is saved until the user chooses a learner

  // Choice of the lesson
  std::vector<LessonStanding> lessons;  // in teaching order
  std::string next, next_why;           // lesson key and reason in one sentence; empty: none
  bool next_by_instructor = false;

  // Current trial
  LessonPhase phase = LessonPhase::none;
  std::string lesson, title, goal;  // the lesson's key, title and goal; empty in phase none
  std::string fail_conditions;      // sentence that names the errors that fail the lesson; may be empty
  LessonMode mode = LessonMode::follow_me;
  bool help_wanted = true;  // chosen by the user; false: no trial is guided
  double guidance = 0.0;    // [1] gain of the lever's guidance in this trial
  double pedal_help = 0.0;  // [1] gain of the help for the feet; if both are 0, the trial is graded
  HintStyle hints = HintStyle::prescriptive;
  bool retention = false;  // first trial after a day: unguided, without hints
  // The trial's prompts and its result so far; empty in phases none and offered. Never null in Coach::view(). They
  // belong to the coach and change with every sample, which is why they are not copied.
  const LessonView* now = nullptr;
  const LessonResult* result = nullptr;
  const Norm* norm = nullptr;  // by which the trial is judged; null: none
  // Told at the end of a graded trial: "Passed once. Pass it again tomorrow or after another lesson."; may be empty
  std::string_view mastery;
  std::string_view mend;    // the one thing to mend, told at the end of a trial; may be empty
  double time_limit = 0.0;  // [s] time limit of the lesson; 0: no lesson
  std::int64_t run = 0;     // number of the run in the history; 0: not saved

  // Past runs
  std::vector<RunRow> runs;  // the learner's runs, newest first, at most kMaxRunsShown
};

inline constexpr std::size_t kMaxRunsShown = 50;

}  // namespace gearshift::lessons
