// What is left of a lesson after a day, or a week, without it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/report/learner_history.h"

namespace gearshift {

inline constexpr double kWeekAfter = 6.0 * 24.0 * 3600.0;  // [s] of a pause, "after a week"

struct RetentionTrial {
  std::int64_t run = 0;
  std::string lesson;  // key
  double pause = 0.0;  // [s] since the run of this lesson before it had begun
  double grade = 0.0;  // [1] of 10
  struct Before {
    std::int64_t run = 0;
    double grade = 0.0;  // [1] of 10
  };
  std::optional<Before> before;  // the last graded run of this lesson; nothing: there was none
};

// Graded runs that follow a pause of kRetentionPause or more since the run of the same lesson before it, graded or not,
// began. Oldest first. Runs that were left or never ended do not count, nor do days that cannot be read.
std::vector<RetentionTrial> retention_trials(const LearnerHistory& history);

std::map<std::int64_t, double> retention_pauses(
    const LearnerHistory& history);  // run to pause [s]; other runs have none

std::string pause_words(double seconds);  // "26 hours", "8 days"

}  // namespace gearshift
