// What there is to be seen of a learner's lessons: plain values, for the panel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/history/history.h"
#include "app/training/hint_style.h"
#include "app/training/lesson_result.h"
#include "app/training/lesson_run.h"

namespace gearshift {

enum class LessonPhase {
  none,
  offered,  // its goal is told; the car waits
  driving,
  over  // the result is told
};

// One lesson of the list, and how this learner stands in it.
struct LessonStanding {
  std::string key, title, task;
  int trials = 0;                // graded
  std::optional<double> grade;   // [1] of 10, of the last graded trial
  bool passed = false;           // in one of them
  std::optional<double> best{};  // [1] of 10, of all graded trials
};

struct CoachView {
  // Who
  std::string learner;                // empty: nobody; nothing is remembered
  std::vector<std::string> learners;  // known, by name
  bool remembers = false;             // the history is open, and the learner in it was not deleted
  bool forgotten = false;             // another program deleted the learner: until a person chooses, nobody's

  // Which
  std::vector<LessonStanding> lessons;  // in the order of teaching
  std::string next, next_why;           // lesson key and one sentence; empty: none
  bool next_by_instructor = false;

  // Now
  LessonPhase phase = LessonPhase::none;
  std::string lesson, title, goal;  // key, words; empty in phase none
  LessonMode mode = LessonMode::follow_me;
  bool help_wanted = true;  // by the person: else no trial is guided
  double guidance = 0.0;    // [1] gain of this trial; 0: it is graded
  HintStyle hints = HintStyle::prescriptive;
  bool retention = false;   // the first trial after a day: unguided and silent
  LessonView now;           // driving and over
  LessonResult result;      // so far, or whole
  double time_limit = 0.0;  // [s] of the lesson; 0: not known
  std::int64_t run = 0;     // its number in the history; 0: it is in none

  // Before
  std::vector<RunRow> runs;                       // of this learner, the newest first, at most kMostRunsShown
  std::vector<std::vector<CommentRow>> comments;  // one list a run
};

inline constexpr std::size_t kMostRunsShown = 50;

}  // namespace gearshift
