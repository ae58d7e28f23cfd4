// The answer that a driveline is held against: Runge-Kutta of order four at 10 us, each mode written out by hand,
// events located to 1e-13 s. Slow, and shares no line with the driveline but the car's curves.
#pragma once

#include <vector>

#include "tests/bench/driveline/drives.h"

namespace gearshift {

struct ReferenceSample {
  double engine = 0.0, shaft = 0.0, road = 0.0;
};

struct DriveOutcome {
  std::vector<ReferenceSample> samples;  // each millisecond, the start first
  double slip_energy = 0.0;              // [J] of the clutch
  double cone_energy = 0.0;              // [J]
  double engine_peak = 0.0;              // [rad/s]
  bool running = true;                   // at the end
};

DriveOutcome reference_of(const Drive& drive);

}  // namespace gearshift
