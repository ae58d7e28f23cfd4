// Suggests the next lesson from the learner's weaknesses.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

// One graded run: unguided, complete, finished. Lists of them are sorted oldest first.
struct PastResult {
  std::string lesson;  // key
  std::string task;
  double grade = 0.0;  // [1] of 10
  bool passed = false;
};
std::optional<PastResult> past_result(const LessonResult& result);  // empty if not graded

struct Suggestion {
  std::string lesson;  // key
  std::string why;     // one sentence
};

// The shipped lessons in teaching order: starting and stopping come before the first gear change, as in Carnetsoft.
inline constexpr std::array<std::string_view, 13> kTeachingOrder{
    "start_and_stop", "bite_point",   "moving_off",     "up_through_the_gears", "down_through_the_gears",
    "reverse",        "hill_start",   "emergency_stop", "skip_shifts",          "eco_driving",
    "rev_matching",   "another_gate", "six_speed"};

// Mean grade of a task's last three results; empty if there are none. [1] of 10
std::optional<double> task_grade(std::span<const PastResult> past, std::string_view task);

// A task's last three results. A task is weaker the more of them failed, then the lower the grade.
struct TaskForm {
  int runs = 0, failed = 0;
  double grade = 0.0;  // [1] of 10, mean
};
// empty if there are no results
std::optional<TaskForm> task_form(std::span<const PastResult> past, std::string_view task);

// In this order: the weakest task that has become weak (at least half of its last three results failed, and its lesson
// was passed once or has three results); the first lesson never passed; the weakest lesson. `lessons` is in teaching
// order; empty if it is empty. The instructor may choose another lesson.
std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const PastResult> past);

}  // namespace gearshift::lessons
