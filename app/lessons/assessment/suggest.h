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

// One graded run: unguided, complete and finished. Lists of past results have the oldest first.
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

// The shipped lessons in teaching order. Starting and stopping come before the first shift, as in Carnetsoft's course.
inline constexpr std::array<std::string_view, 13> kTeachingOrder{
    "start_and_stop", "bite_point",   "moving_off",     "up_through_the_gears", "down_through_the_gears",
    "reverse",        "hill_start",   "emergency_stop", "skip_shifts",          "eco_driving",
    "rev_matching",   "another_gate", "six_speed"};

// Mean grade of a task's last three results; empty if there are none. [1] of 10
std::optional<double> task_grade(std::span<const PastResult> past, std::string_view task);

// A task's last three results. The task with more failed runs is the weaker; among equals, that with the lower grade.
struct RecentResults {
  int runs = 0, failed = 0;
  double grade = 0.0;  // [1] of 10, mean grade
};
// Empty if there are no results.
std::optional<RecentResults> recent_results(std::span<const PastResult> past, std::string_view task);

// Suggests, in this order of priority: the weakest lesson that needs practice (at least half of its task's last three
// results failed, and the lesson was passed once or the task has three results); the first lesson never passed; the
// weakest lesson. `lessons` is in teaching order; if it is empty, so is the result. The instructor may choose a
// different lesson.
std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const PastResult> past);

}  // namespace gearshift::lessons
