// Retention: how much of a lesson is left after a break of a day or a week.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

inline constexpr double kWeekAfter = 6.0 * 24.0 * 3600.0;  // [s] a break at least this long counts as a week

struct RetentionTrial {
  std::int64_t run = 0;
  std::string lesson;  // key
  double pause = 0.0;  // [s] since the previous run of this lesson began
  double grade = 0.0;  // [1] of 10
  struct Before {
    std::int64_t run = 0;
    double grade = 0.0;  // [1] of 10
  };
  std::optional<Before> before;  // the previous graded run of this lesson; empty: none
};

// Graded runs that began at least kRetentionPause after the previous run of the same lesson, graded or not. Oldest
// first. Runs that ended early or never ended are ignored, and so are unreadable dates.
std::vector<RetentionTrial> retention_trials(const LearnerHistory& history);

// Maps the run numbers of retention trials to the break before each [s].
std::map<std::int64_t, double> retention_pauses(const LearnerHistory& history);

std::string format_pause(double seconds);  // "26 hours", "8 days"

}  // namespace gearshift::lessons
