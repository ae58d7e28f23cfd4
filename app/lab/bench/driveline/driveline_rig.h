// Cars with all but one law switched off, and ways to drive them.
#pragma once

#include <cmath>

#include "app/vehicle/driveline.h"

namespace gearshift::lab {

inline constexpr double kPerRoad = 10.0;  // [rad/m] shaft rotation per distance travelled in first gear

// Inertias at the clutch [kg m^2]: `one` is the engine's, `other` that of car and clutch disc. At full throttle the
// engine gives `torque` at every speed. The clutch is the only friction.
inline vehicle::CarSpec bare_car(double one, double other, double capacity, double torque = 0.0) {
  vehicle::CarSpec car;
  car.engine.full_load[0] = {0.0, torque};
  car.engine.full_load[1] = {1e6, torque};
  car.engine.points = 2;
  car.engine.friction = 0.0;
  car.engine.inertia = one;
  car.engine.idle_gain = car.engine.stall = 0.0;
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
  in.throttle = throttle;
  in.clutch = clutch;
  return in;
}

inline double slip(const vehicle::Driveline& line) {
  return line.state().engine_speed - line.state().shaft_speed;
}

inline void drive(vehicle::Driveline& line, const vehicle::DrivelineInput& in, double seconds, double step = 0.001) {
  for (int i = 0; i < std::lround(seconds / step); ++i) line.step(in, step);
}

// The time when `done` first holds, found by shortening the last step; negative if it does not within 1000 s. The input
// is constant, or a function of the time at the end of a step.
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
