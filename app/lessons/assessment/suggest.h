// Suggests the next lesson from what the learner has passed, failed and tried.
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
  std::optional<std::int64_t> begun{};  // [s] since 1970, of begun_at
  std::string car{};
  double path_length = 0.0;  // [m] see LessonResult
};

// A finished run without a grade.
struct UngradedTrial {
  std::string task;
  bool was_left = false;    // given up by the learner
  bool was_guided = false;  // neither: data or forces were missing
};

struct Suggestion {
  std::string lesson;  // key
  std::string why;     // one sentence
};

// The shipped lessons in teaching order. Starting and stopping come before the first shift, as in the driving course by
// Carnetsoft.
inline constexpr std::array<std::string_view, 26> kTeachingOrder{"start_and_stop",
                                                                 "bite_point",
                                                                 "moving_off",
                                                                 "stop_and_go",
                                                                 "up_through_the_gears",
                                                                 "down_through_the_gears",
                                                                 "reverse",
                                                                 "hill_start",
                                                                 "hill_start_with_foot_brake",
                                                                 "hold_on_the_clutch",
                                                                 "downhill_start",
                                                                 "engine_braking",
                                                                 "down_before_a_bend",
                                                                 "emergency_stop",
                                                                 "away_in_time",
                                                                 "stalled_in_a_junction",
                                                                 "reverse_uphill",
                                                                 "reverse_downhill",
                                                                 "parking_in_gear",
                                                                 "bump_start",
                                                                 "skip_shifts",
                                                                 "eco_driving",
                                                                 "rev_matching",
                                                                 "heel_and_toe",
                                                                 "another_gate",
                                                                 "six_speed"};

// Summary of a task's last three results. The task with the larger fraction of failed runs is the weaker one; if the
// fractions are equal, the task with the lower grade.
struct RecentResults {
  int runs = 0, failed = 0;
  bool failed_last = false;  // the newest one failed
  double grade = 0.0;        // [1] 0 to 10, mean; from the newest on, the grades have weights of 3, 2 and 1
};
// Empty if there are no results.
std::optional<RecentResults> recent_results(std::span<const GradedTrial> past, std::string_view task);

// True if the newest run failed, and at least half of them: one bad run among good ones is no weakness, and a run that
// was passed after failed ones is an improvement.
bool is_weak(const RecentResults& form) noexcept;

// True if the task of this name, or with &GradedTrial::lesson the lesson, was passed twice, the second time on another
// day or after a graded run of another one.
bool was_confirmed(std::span<const GradedTrial> past, std::string_view name,
                   std::string GradedTrial::*of = &GradedTrial::task);

struct Tries {
  int passed = 0, failed = 0;                 // graded
  int guided = 0, given_up = 0, cut_off = 0;  // not graded; cut_off: data or forces were missing
};
Tries count_tries(std::span<const GradedTrial> past, std::span<const UngradedTrial> others, std::string_view task);
std::string tries_text(const Tries& tries);  // those that were not passed: "2 failed, 3 guided"; may be empty

// [s] A confirmed lesson not driven for so long is due for a retention test; once that is passed, for a transfer test,
// with another car or gate. The retention interval of studies on guidance is a day to two weeks (guidance.h).
inline constexpr std::int64_t kTestDue = std::int64_t{7} * 24 * 3600;

// Suggests, in this order: a due test, at most one a day; the first lesson that was never passed, the weakest of those
// with is_weak(), the first not confirmed, the weakest. `lessons` is in teaching order; if it is empty, the result is
// empty, too. `now`: [s] since 1970; empty: no test is due.
std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const GradedTrial> past,
                                         std::span<const UngradedTrial> others, std::optional<std::int64_t> now = {});

}  // namespace gearshift::lessons
