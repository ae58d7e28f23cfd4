// Ways to step a driveline, side by side.
#pragma once

#include "tests/bench/driveline/reference.h"

namespace gearshift {

enum class DriveMethod {
  events,    // Driveline: modes, located events, midpoint rule
  impulses,  // all grips as limited impulses, solved together once a step; no events
  tanh       // explicit Euler, each grip T tanh(slip / eps) with eps = 10 rad/s: no solver, no modes
};

const char* name_of(DriveMethod method);

// Samples each `step` [s] instead of each millisecond; else as the reference.
DriveOutcome drive_by(DriveMethod method, const Drive& drive, double step);

}  // namespace gearshift
