// Thresholds and severities of all driving errors, in one table.
#pragma once

#include "app/lessons/assessment/driving_error.h"

namespace gearshift::lessons {

struct ErrorRule {
  ErrorKind kind = ErrorKind::stall;
  double raise = 0.0;  // smallest value that is an error
  double clear = 0.0;  // an ongoing error ends below this value, so that one mistake is one error
  double grave = 0.0;  // smallest value at which the error is one class more severe
  Severity severity = Severity::minor;
};

// raise, clear and grave are in the unit that ErrorKind gives, with these exceptions: over_rev is a fraction of the
// car's red line, slow_step a fraction of the step's allowed time, jerk a fraction of jerk_limit(), clutch_burn a
// fraction of burn_limit() (clutch_release.h), early_downshift a fraction of max_downshift_speed() (error_detector.h).
const ErrorRule& error_rule(ErrorKind kind) noexcept;

// Severity of an error. value: in the unit of the kind's rule.
Severity error_severity(ErrorKind kind, double value) noexcept;

// A clutch dump is a release from bite point to fully up in less than this time, with more slip power than
// clutch_dump's threshold.
inline constexpr double kFastRelease = 0.15;  // [s] engineering value

// Gaps shorter than this do not end an episode.
inline constexpr double kEpisodeGap = 0.3;  // [s] engineering value

}  // namespace gearshift::lessons
