// The shipped cars, and what all tests of a car in gear need.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "app/vehicle/car_spec.h"
#include "tests/support/gates.h"

namespace gearshift {

inline constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
inline constexpr double kPaperForce = 31.7;              // [N] peak of the paper's lever

inline CarSpec shipped_car(const std::string& name) {
  return read_car(GEARSHIFT_ASSETS "/cars/" + name + ".toml");
}

inline Gate gate_of(const CarSpec& car) {
  return shipped_gate(car.gate);
}

inline double ratio_of(const CarSpec& car, int gear) {
  return std::abs(shaft_per_road(car, gear)) * car.body.wheel_radius / car.gearbox.final_drive;
}

// [m/s] at which that gear turns the shaft so fast.
inline double road_speed_at(const CarSpec& car, int gear, double shaft_speed) {
  return shaft_speed / shaft_per_road(car, gear);
}

}  // namespace gearshift
