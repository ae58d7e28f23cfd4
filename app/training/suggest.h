// Which lesson comes next: by what is weak.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/training/lesson.h"
#include "app/training/lesson_result.h"

namespace gearshift {

// One run that was graded: unguided, whole, over. The oldest first.
struct PastResult {
  std::string lesson;  // key
  std::string task;
  double grade = 0.0;  // [1] of 10
  bool passed = false;
};
std::optional<PastResult> past_result(const LessonResult& result);  // nothing where it was not graded

struct Suggestion {
  std::string lesson;  // key
  std::string why;     // one sentence
};

// The shipped lessons as they build on each other: to start and to stop before any gear is changed, as Carnetsoft does.
inline constexpr std::array<std::string_view, 13> kTeachingOrder{
    "start_and_stop", "bite_point",   "moving_off",     "up_through_the_gears", "down_through_the_gears",
    "reverse",        "hill_start",   "emergency_stop", "skip_shifts",          "eco_driving",
    "rev_matching",   "another_gate", "six_speed"};

// Mean grade of a task's last three results; none where it has none. [1] of 10
std::optional<double> task_grade(std::span<const PastResult> past, std::string_view task);

// How a task's last three results were: the more of them were not passed, the weaker; then the lower the grade.
struct TaskForm {
  int runs = 0, failed = 0;
  double grade = 0.0;  // [1] of 10, their mean
};
std::optional<TaskForm> task_form(std::span<const PastResult> past, std::string_view task);  // none where it has none

// In this order: a task that has become weak (half or more of its last three results were not passed, and its lesson
// was passed once or has three of them), the weakest first; the first lesson that was never passed; the weakest.
// `lessons` in the order of teaching; nothing where it is empty. The instructor may choose otherwise.
std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const PastResult> past);

}  // namespace gearshift
