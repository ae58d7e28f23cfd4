// A learner's standing in each task, in an instructor's words.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

// can: confirmed (was_confirmed() in suggest.h) and not weak at present. nearly: one of the last three graded runs was
// passed. not_yet: none of them. not_tried: no run, not even a guided one or one that was given up.
enum class Standing : std::uint8_t { not_tried, not_yet, nearly, can };
std::string_view to_string(Standing standing) noexcept;  // "not tried", "not yet", "nearly", "can"

struct TaskStanding {
  std::string task;  // key
  Standing standing = Standing::not_tried;
  std::string sentence;  // why, in one sentence; empty: not tried
  std::string advice;    // what to do next; may be empty
};

// The tasks of the lessons, in teaching order, then other tasks of the history.
std::vector<TaskStanding> task_standings(const LearnerHistory& history, std::span<const Lesson> lessons);

// The next lesson and why: chosen by the instructor, otherwise suggested.
struct NextLesson {
  std::string lesson;  // key; empty: none
  std::string why;     // one sentence
  bool by_instructor = false;
};
NextLesson next_lesson(const LearnerHistory& history, std::span<const Lesson> lessons);

}  // namespace gearshift::lessons
