// Retention: how well a learner still drives a lesson after a break of a day or a week.
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

// Graded runs that began at least kRetentionPause after the previous run of the same lesson, graded or not. The oldest
// is first. Runs that ended early or never ended are ignored. A run is left out if its date or the previous run's date
// is unreadable.
std::vector<RetentionTrial> retention_trials(const LearnerHistory& history);

// Maps the run number of each retention trial to the break before the trial [s].
std::map<std::int64_t, double> retention_pauses(const LearnerHistory& history);

std::string format_pause(double seconds);  // for example "26 hours" or "8 days"

}  // namespace gearshift::lessons
