// Integration methods for the driveline, to be compared with each other.
#pragma once

#include "app/lab/bench/driveline/reference.h"

namespace gearshift::lab {

enum class DriveMethod {
  events,    // the shipped Driveline: friction modes, located events, midpoint rule
  impulses,  // friction as limited impulses, solved for all contacts together once per step; no events
  tanh       // explicit Euler; friction T tanh(slip / eps) with torque limit T and eps = 10 rad/s; no solver, no modes
};

const char* to_string(DriveMethod method);

// Like reference_of(), but uses the given method and takes a sample every `step` [s].
DriveOutcome drive_by(DriveMethod method, const Drive& drive, double step);

}  // namespace gearshift::lab
