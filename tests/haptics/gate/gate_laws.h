// Laws that every gate must satisfy, whether shipped or random. Shared by the tests in this folder.
#pragma once

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "haptics/gate/gate.h"

namespace gearshift::test {

// True if the paper's yoke reaches this point of the gate plane with both angles inside their stops. Uses eq (2) of the
// paper, corrected: px = rho tan(theta) / s, py = -rho tan(phi) / s, pz = rho / s with s = sqrt(1 + tan^2 theta + tan^2
// phi).
inline bool yoke_reaches(glm::dvec2 point) {
  constexpr double kRho = 0.120;
  const double height_squared = kRho * kRho - point.x * point.x - point.y * point.y;
  if (height_squared <= 0.0) return false;
  const double height = std::sqrt(height_squared);
  const double theta = std::atan2(std::abs(point.x), height) * 180.0 / std::numbers::pi;
  const double phi = std::atan2(std::abs(point.y), height) * 180.0 / std::numbers::pi;
  return theta < 40.0 && phi < 35.0;
}

// Slope dF/dx [N/m] of the curve behind this point, from two forces 1 nm apart.
inline double feel_slope(const haptics::FeelCurve& curve, double at) {
  constexpr double kStep = 1e-9;
  return (haptics::feel_force(curve, at + kStep) - haptics::feel_force(curve, at)) / kStep;
}

// On the chamfers, the force along x must not depend on x and the force along y must not depend on y. Otherwise a lever
// could gain energy by moving round the corner.
inline void check_constant_at_mouths(const haptics::Gate& gate) {
  constexpr int kSteps = 20;
  const double at_wall = haptics::feel_force(gate.aisle_feel, gate.half_aisle);
  for (int i = 0; i <= kSteps; ++i) {
    const double leg = gate.chamfer * i / kSteps;
    for (const haptics::Slot& slot : haptics::slots(gate)) {
      CHECK(std::abs(feel_slope(slot.feel, gate.half_aisle + leg)) < 1.0);
      CHECK(haptics::feel_force(slot.feel, gate.half_aisle + leg) == doctest::Approx(at_wall));
    }
    for (const haptics::Column& column : haptics::columns(gate)) {
      for (const double off : {-column.half_width - leg, column.half_width + leg}) {
        CHECK(std::abs(feel_slope(gate.select_feel, column.center + off)) < 1.0);
      }
    }
  }
}

}  // namespace gearshift::test
