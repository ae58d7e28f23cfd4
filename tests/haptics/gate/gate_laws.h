// Laws that every gate must keep, shipped or random, for the tests of this room.
#pragma once

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "haptics/gate/gate.h"

namespace gearshift {

// Eq (2) corrected: px = rho tan(theta) / s, py = -rho tan(phi) / s, pz = rho / s with
// s = sqrt(1 + tan^2 theta + tan^2 phi).
// The paper's yoke reaches a point of the gate plane if both angles stay inside their stops.
inline bool yoke_reaches(glm::dvec2 point) {
  constexpr double kRho = 0.120;
  const double height_squared = kRho * kRho - point.x * point.x - point.y * point.y;
  if (height_squared <= 0.0) return false;
  const double height = std::sqrt(height_squared);
  const double theta = std::atan2(std::abs(point.x), height) * 180.0 / std::numbers::pi;
  const double phi = std::atan2(std::abs(point.y), height) * 180.0 / std::numbers::pi;
  return theta < 40.0 && phi < 35.0;
}

// On the chamfers neither force may depend on where along itself
// the lever is, or going round the corner would give energy.
inline void check_constant_at_mouths(const Gate& gate) {
  constexpr int kSteps = 20;
  const double at_wall = feel_force(gate.aisle_feel, gate.half_aisle);
  for (int i = 0; i <= kSteps; ++i) {
    const double leg = gate.chamfer * i / kSteps;
    for (const Slot& slot : slots(gate)) {
      CHECK(feel_slope(slot.feel, gate.half_aisle + leg) == doctest::Approx(0.0).epsilon(1e-9));
      CHECK(feel_force(slot.feel, gate.half_aisle + leg) == doctest::Approx(at_wall));
    }
    for (const Column& column : columns(gate)) {
      for (const double off : {-column.half_width - leg, column.half_width + leg}) {
        CHECK(feel_slope(gate.select_feel, column.center + off) == doctest::Approx(0.0).epsilon(1e-9));
      }
    }
  }
}

}  // namespace gearshift
