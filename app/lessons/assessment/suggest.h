// Suggests the next lesson from the learner's weaknesses.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/lessons/assessment/lesson.h"

namespace gearshift::lessons {

// A graded run: unguided, complete and finished. Lists of trials have the oldest first.
struct GradedTrial {
  std::string lesson;  // key
  std::string task;
  double grade = 0.0;  // [1] 0 to 10
  bool passed = false;
  std::int64_t run = 0;    // number in the history
  std::string begun_at{};  // ISO 8601, UTC
  double pause = 0.0;      // [s] break of at least kRetentionPause since the lesson's previous run; 0: none
};

struct Suggestion {
  std::string lesson;  // key
  std::string why;     // one sentence
};

// The shipped lessons in teaching order. Starting and stopping come before the first shift, as in the driving course by
// Carnetsoft.
inline constexpr std::array<std::string_view, 13> kTeachingOrder{
    "start_and_stop", "bite_point",   "moving_off",     "up_through_the_gears", "down_through_the_gears",
    "reverse",        "hill_start",   "emergency_stop", "skip_shifts",          "eco_driving",
    "rev_matching",   "another_gate", "six_speed"};

// Mean grade of a task's last three results [1], 0 to 10; empty if there are none.
std::optional<double> task_grade(std::span<const GradedTrial> past, std::string_view task);

// Summary of a task's last three results. The task with the larger fraction of failed runs is the weaker one; if the
// fractions are equal, the task with the lower grade.
struct RecentResults {
  int runs = 0, failed = 0;
  double grade = 0.0;  // [1] 0 to 10, mean grade
};
// Empty if there are no results.
std::optional<RecentResults> recent_results(std::span<const GradedTrial> past, std::string_view task);

// Suggests the weakest lesson that needs practice. If none needs practice, suggests the first lesson never passed. If
// all were passed, suggests the weakest lesson. A lesson needs practice if at least half of its task's last three
// results failed, and if the lesson was passed once or the task has three results. `lessons` is in teaching order; if
// it is empty, the result is empty, too.
std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const GradedTrial> past);

}  // namespace gearshift::lessons
