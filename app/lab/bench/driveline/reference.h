// Reference solution for the driveline: fourth-order Runge-Kutta with steps of 10 us, a separate implementation of each
// friction mode, and events located to 1e-13 s. The reference is slow. It shares no code with the driveline except the
// car's curves.
#pragma once

#include <vector>

#include "app/lab/bench/driveline/drives.h"

namespace gearshift::lab {

struct ReferenceSample {
  double engine = 0.0, shaft = 0.0, road = 0.0;
};

struct DriveOutcome {
  std::vector<ReferenceSample> samples;  // one per millisecond, including time 0
  double slip_energy = 0.0;              // [J] dissipated in the clutch
  double cone_energy = 0.0;              // [J]
  double temperature = 0.0;              // [C] of the clutch at the end
  double engine_peak = 0.0;              // [rad/s]
  bool running = true;                   // at the end
};

DriveOutcome reference_of(const Drive& drive);

}  // namespace gearshift::lab
