// Alternative integration methods for the driveline.
#pragma once

#include "app/lab/bench/driveline/reference.h"

namespace gearshift::lab {

enum class DriveMethod {
  events,    // Driveline: modes, located events, midpoint rule
  impulses,  // all friction contacts as limited impulses, solved together once per step; no events
  tanh       // explicit Euler, friction T tanh(slip / eps) with eps = 10 rad/s: no solver, no modes
};

const char* to_string(DriveMethod method);

// Like reference_of(), but with a sample every `step` [s] instead of every millisecond.
DriveOutcome drive_by(DriveMethod method, const Drive& drive, double step);

}  // namespace gearshift::lab
