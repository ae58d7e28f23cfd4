// Simplified cars that isolate one law of the driveline, and functions that drive them.
#pragma once

#include <cmath>

#include "app/vehicle/driveline.h"

namespace gearshift::lab {

inline constexpr double kPerRoad = 10.0;  // [rad/m] shaft rotation per distance travelled in first gear

// A car in which only the clutch has friction. `one`: inertia of the engine [kg m^2]. `other`: inertia of car and
// clutch disc, converted to the clutch shaft [kg m^2]. `capacity`: largest torque of the clutch [N m]. `torque`: torque
// of the engine at full throttle, the same at every speed [N m].
inline vehicle::CarSpec bare_car(double one, double other, double capacity, double torque = 0.0) {
  vehicle::CarSpec car;
  car.engine.full_load[0] = {0.0, torque};
  car.engine.full_load[1] = {1e6, torque};
  car.engine.points = 2;
  car.engine.friction = 0.0;
  car.engine.inertia = one;
  car.engine.idle_gain = car.engine.idle_integral_gain = car.engine.idle_lift = car.engine.stall = 0.0;
  car.engine.limiter = 1e9;
  car.clutch.capacity = capacity;
  car.gearbox.ratio = {1.0};
  car.gearbox.final_drive = 1.0;
  car.gearbox.drag = car.gearbox.drag_slope = 0.0;
  car.body.wheel_radius = 1.0 / kPerRoad;
  car.body.mass = (other - car.clutch.disc_inertia) * kPerRoad * kPerRoad;
  car.body.rotating = car.body.resistance = car.body.resistance_slope = car.body.resistance_square = 0.0;
  return car;
}

inline vehicle::DrivelineInput pedals(int gear, double throttle, double clutch) {
  vehicle::DrivelineInput in;
  in.meshed = gear;
  in.pedals.throttle = throttle;
  in.pedals.clutch = clutch;
  return in;
}

inline void drive(vehicle::Driveline& line, const vehicle::DrivelineInput& in, double seconds, double step = 0.001) {
  for (int i = 0; i < std::lround(seconds / step); ++i) line.step(in, step);
}

// Returns the time at which `done` first becomes true, or a negative value if `done` stays false for 1000 s. Shortens
// the last step to find that time. `input`: a constant, or a function of the time at the end of a step.
template <typename Input, typename Done>
double time_until(vehicle::Driveline& line, const Input& input, double step, const Done& done) {
  const auto at = [&](double t) {
    if constexpr (std::is_invocable_v<Input, double>)
      return input(t);
    else
      return input;
  };
  line.step(at(0.0), 0.0);
  for (int i = 0; i * step < 1000.0; ++i) {
    const vehicle::Driveline before = line;
    line.step(at((i + 1) * step), step);
    if (!done(line)) continue;
    double low = 0.0, high = step;
    while (high - low > 1e-12) {
      const double middle = 0.5 * (low + high);
      vehicle::Driveline cut = before;
      cut.step(at(i * step + middle), middle);
      (done(cut) ? high : low) = middle;
    }
    return i * step + high;
  }
  return -1.0;
}

}  // namespace gearshift::lab
