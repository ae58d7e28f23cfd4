// The shipped cars, and functions for tests that use them.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/driveline.h"
#include "tests/support/gates.h"

namespace gearshift::test {

inline constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
inline constexpr double kPaperForce = 31.7;              // [N] the largest force of the paper's lever

inline vehicle::CarSpec shipped_car(const std::string& name) {
  return vehicle::read_car(GEARSHIFT_ASSETS "/cars/" + name + ".toml");
}

inline haptics::Gate gate_of(const vehicle::CarSpec& car) {
  return shipped_gate(car.gate);
}

inline double slip(const vehicle::Driveline& line) {  // [rad/s]
  return line.state().engine_speed - line.state().shaft_speed;
}

inline double ratio_of(const vehicle::CarSpec& car, int gear) {
  return std::abs(vehicle::shaft_per_road(car, gear)) * car.body.wheel_radius / car.gearbox.final_drive;
}

// [m/s] The road speed at which the shaft turns at `shaft_speed` [rad/s] in `gear`.
inline double road_speed_at(const vehicle::CarSpec& car, int gear, double shaft_speed) {
  return shaft_speed / vehicle::shaft_per_road(car, gear);
}

// Cone friction [1] below which the ring's teeth turn the ring aside, by the wedge's angle of friction: n mu R / sin a of
// the cone equals R_t cot(b + atan mu_t) of the teeth.
inline double critical_friction(const vehicle::SynchroSpec& synchro) {
  const double teeth = synchro.index_radius / std::tan(synchro.pointing_angle + std::atan(synchro.index_friction));
  return teeth * std::sin(synchro.cone_angle) / (synchro.cones * synchro.radius);
}

}  // namespace gearshift::test
