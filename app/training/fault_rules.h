// From what value on a deed is a fault, and how bad it is: one table.
#pragma once

#include "app/training/drive_fault.h"

namespace gearshift {

struct FaultRule {
  FaultKind kind = FaultKind::stall;
  double raise = 0.0;  // from this value on it is a fault
  double clear = 0.0;  // what lasts is over below this: one deed is one fault
  double grave = 0.0;  // from this value on it is one class worse
  Severity severity = Severity::minor;
};

// raise, clear and grave are in the kind's unit, but in shares of the car's red line for over_rev, of the time that the
// step gives for slow_step, of jerk_limit and burn_limit (clutch_release.h) for jerk and clutch_burn, of what suits
// (fault_watch.h) for early_downshift.
const FaultRule& fault_rule(FaultKind kind) noexcept;

// Of a fault with that value, in the unit of the rule.
Severity fault_severity(FaultKind kind, double value) noexcept;

// The clutch is dumped where more than clutch_dump's power is burnt and it was let up in less than this, from its bite
// point to closed.
inline constexpr double kFastRelease = 0.15;  // [s] [engineering value]

// Gaps shorter than this do not end what lasts.
inline constexpr double kEpisodeGap = 0.3;  // [s] [engineering value]

}  // namespace gearshift
