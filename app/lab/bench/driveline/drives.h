// Drives that are difficult for a driveline: car, initial state, and pedals as a function of time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/vehicle/driveline.h"

namespace gearshift::lab {

inline constexpr double kDriveGravity = 9.81;  // [m/s^2]

// A 1.6 l petrol hatchback with parameters taken from an independent simulation, which also gives the result for
// launch().
vehicle::CarSpec hatchback();

struct Drive {
  std::string name;
  vehicle::CarSpec car;
  double engine = 84.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s], [m/s] initial speeds
  double duration = 1.0;                          // [s]
  std::function<vehicle::DrivelineInput(double seconds)> input;
};

Drive launch();  // clutch released within 1.5 s, some throttle; the independent simulation: 2.02 kJ, lock-up at 1.303 s
// launch() with a little more throttle, because the shipped hatchback stalls with launch()'s throttle.
Drive launch_of(const vehicle::CarSpec& car);
Drive dump_at_idle();     // clutch released within 30 ms at idle: stalls
Drive dump_at_4000();     // clutch released within 30 ms at 4000 rpm
Drive money_shift();      // shift into second at 30 m/s
Drive rollback();         // on a hill: rolls back, is stopped by the clutch and drives uphill
Drive reverse_ahead();    // reverse engaged at +5 m/s
Drive first_backwards();  // first engaged at -4 m/s
Drive cone_only();        // the synchroniser matches speeds with the clutch down and the car rolling
Drive cone_and_engine();  // synchroniser, clutch up
std::vector<Drive> all_drives();

// Linear ramp from one value to another between two times.
double ramp(double seconds, double start, double end, double from, double to);

}  // namespace gearshift::lab
