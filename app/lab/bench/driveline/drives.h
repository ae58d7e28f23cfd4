// Drives that are difficult to simulate. Each has a car, an initial state, and pedals as a function of time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/vehicle/driveline.h"

namespace gearshift::lab {

inline constexpr double kDriveGravity = 9.81;  // [m/s^2]

// A petrol hatchback with a 1.6 l engine. Its parameters come from an independent simulation, which also gives the
// expected result of launch().
vehicle::CarSpec hatchback();

struct Drive {
  std::string name;
  vehicle::CarSpec car;
  double engine = 84.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s], [m/s] initial speeds
  double duration = 1.0;                          // [s]
  std::function<vehicle::DrivelineInput(double seconds)> input;
};

// Clutch released within 1.5 s. The independent simulation gives 2.02 kJ of slip energy and lock-up at 1.303 s.
Drive launch();
// Like launch(), but with more throttle, because the shipped hatchback stalls with the throttle of launch().
Drive launch_of(const vehicle::CarSpec& car);
Drive dump_at_idle();     // clutch released within 30 ms at idle; the engine stalls
Drive dump_at_4000();     // clutch released within 30 ms at 4000 rpm
Drive money_shift();      // shift into second at 30 m/s
Drive rollback();         // the car rolls back on a hill until the clutch stops it, then drives uphill
Drive reverse_ahead();    // reverse is engaged at a road speed of +5 m/s
Drive first_backwards();  // first gear is engaged at a road speed of -4 m/s
Drive cone_only();        // the synchroniser matches the speeds while the clutch is disengaged and the car rolls
Drive cone_and_engine();  // the synchroniser matches the speeds while the clutch is engaged
std::vector<Drive> all_drives();

// Linear ramp from the value `from` at time `start` to the value `to` at time `end`.
double ramp(double seconds, double start, double end, double from, double to);

}  // namespace gearshift::lab
