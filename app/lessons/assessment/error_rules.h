// Thresholds and severities of all driving errors, in one table.
#pragma once

#include "app/lessons/assessment/driving_error.h"

namespace gearshift::lessons {

struct ErrorRule {
  ErrorKind kind = ErrorKind::stall;
  double raise = 0.0;  // smallest value that is an error
  double clear = 0.0;  // an error in progress ends below this value (hysteresis)
  double grave = 0.0;  // smallest value at which the error is one severity class higher
  Severity severity = Severity::minor;
};

// `raise`, `clear` and `grave` have the unit given at ErrorKind, except for relative values: `over_rev` is relative to
// the car's red line, `slow_step` to the step's allowed time, `jerk` to jerk_limit() and `clutch_burn` to burn_limit()
// (clutch_release.h), `early_downshift` to max_downshift_speed() (error_detector.h).
const ErrorRule& error_rule(ErrorKind kind) noexcept;

// Returns the severity of an error. `value`: measured value, in the unit of `error_rule(kind).raise`.
Severity error_severity(ErrorKind kind, double value) noexcept;

// A clutch release that takes less than this time from the bite point to fully up is a clutch dump, if its slip power
// reaches the threshold of `clutch_dump`.
inline constexpr double kFastRelease = 0.15;  // [s] engineering value

// An episode continues through gaps shorter than this.
inline constexpr double kEpisodeGap = 0.3;  // [s] engineering value

}  // namespace gearshift::lessons
