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
  bool running = true;                            // the engine fires at the start
  double temperature = vehicle::kAirTemperature;  // [C] of the clutch at the start
  std::function<vehicle::DrivelineInput(double seconds)> input;
};

// Clutch released within 1.5 s. A separate program gives 2.302 kJ of slip energy and lock-up at 1.322 s.
Drive launch();
// Like launch(), with more throttle.
Drive launch_of(const vehicle::CarSpec& car);
// No throttle: the idle control moves the car off while the clutch comes up from bite to closed in `seconds`.
Drive pull_away(const vehicle::CarSpec& car, int gear, double seconds);
Drive dump_at_idle();     // clutch released within 30 ms at idle; the engine stalls
Drive dump_at_4000();     // clutch released within 30 ms at 4000 rpm
Drive money_shift();      // shift into second at 30 m/s
Drive rollback();         // the car rolls back on a hill until the clutch stops it, then drives uphill
Drive reverse_ahead();    // reverse is engaged at a road speed of +5 m/s
Drive first_backwards();  // first gear is engaged at a road speed of -4 m/s
Drive cone_only();        // the synchroniser matches the speeds while the clutch is disengaged and the car rolls
Drive cone_and_engine();  // the synchroniser matches the speeds while the clutch is engaged
Drive rolls_back_dead();  // the clutch comes up while the car rolls back with a dead engine, and turns it backwards
Drive bump_start();       // the clutch comes up in second at 15 km/h, and the engine fires
Drive cranking();         // the starter turns the engine until it fires and idles
Drive hot_launch();       // the clutch is so hot that it fades, and hotter at the end
std::vector<Drive> all_drives();
std::vector<Drive> engine_drives();  // the last four: a dead engine, a hot clutch

// Linear ramp from the value `from` at time `start` to the value `to` at time `end`.
double ramp(double seconds, double start, double end, double from, double to);

}  // namespace gearshift::lab
