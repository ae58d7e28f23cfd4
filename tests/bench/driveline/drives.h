// Drives that are hard for a driveline: the car, how it begins, and what the feet do as a function of time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/vehicle/driveline.h"

namespace gearshift {

inline constexpr double kDriveGravity = 9.81;  // [m/s^2]

// The 1.6 l petrol hatchback that another program drove.
CarSpec hatchback();

struct Drive {
  std::string name;
  CarSpec car;
  double engine = 84.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s], [m/s] at the start
  double duration = 1.0;                          // [s]
  std::function<DrivelineInput(double seconds)> input;
};

Drive launch();  // clutch let up within 1.5 s, some throttle: 2.02 kJ, locked after 1.303 s by that
// The same foot with a little more throttle: that car stalls with launch's. car: the shipped hatchback.
Drive launch_of(const CarSpec& car);
Drive dump_at_idle();     // let up within 30 ms: it stalls
Drive dump_at_4000();     // the same with revs
Drive money_shift();      // into second at 30 m/s
Drive rollback();         // on a hill: rolls back, is caught by the clutch, goes on uphill
Drive reverse_ahead();    // reverse in, at +5 m/s
Drive first_backwards();  // first in, at -4 m/s
Drive cone_alone();       // synchroniser, clutch down, car rolling
Drive cone_and_engine();  // synchroniser, clutch up
std::vector<Drive> all_drives();

// A number that goes from one value to another between two times, straight.
double ramp(double seconds, double start, double end, double from, double to);

}  // namespace gearshift
