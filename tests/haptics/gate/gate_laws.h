// Laws that every gate must satisfy, whether shipped or random. Shared by the tests in this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_feel.h"

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

// Potential energy of gate_feel(): minus the work of the force on the way from the origin along the aisle's centre line
// and then into the slot. Gauss's rule with three points is exact, because between two kinks the forces are polynomials
// of degree 5 at most.
class GateEnergy {
 public:
  explicit GateEnergy(const haptics::Gate& gate) : gate_(gate), along_{gate.half_aisle} {
    add(gate.select_feel, across_);
    add(gate.aisle_feel, along_);
    for (const haptics::Slot& slot : haptics::slots(gate)) add(slot.feel, along_);
    for (const haptics::Buffer& buffer : haptics::buffers(gate))
      across_.insert(across_.end(), {std::abs(buffer.inner), std::abs(buffer.wall)});
    for (std::vector<double>* kinks : {&across_, &along_}) {
      std::sort(kinks->begin(), kinks->end());
      kinks->erase(std::unique(kinks->begin(), kinks->end()), kinks->end());
    }
  }

  double at(glm::dvec2 p) const {  // [J]
    return -work(across_, p.x, [&](double x) {
      return haptics::gate_feel(gate_, {x, 0.0}).x;
    }) - work(along_, p.y, [&](double y) {
      return haptics::gate_feel(gate_, {p.x, y}).y;
    });
  }

 private:
  static void add(const haptics::FeelCurve& curve, std::vector<double>& kinks) {
    for (int i = 0; i < curve.pieces; ++i) kinks.push_back(std::abs(curve.piece[static_cast<std::size_t>(i)].from));
  }

  static double work(const std::vector<double>& kinks, double to, const auto& force) {
    const double sign = to < 0.0 ? -1.0 : 1.0, end = std::abs(to), off = std::sqrt(0.6);
    double sum = 0.0, from = 0.0;
    const auto add_piece = [&](double until) {
      const double middle = 0.5 * (from + until), half = 0.5 * (until - from);
      const auto at = [&](double u) { return force(sign * (middle + half * u)); };
      sum += sign * half * (5.0 * at(-off) + 8.0 * at(0.0) + 5.0 * at(off)) / 9.0;
      from = until;
    };
    for (const double kink : kinks)
      if (kink > from && kink < end) add_piece(kink);
    add_piece(end);
    return sum;
  }

  const haptics::Gate& gate_;
  std::vector<double> across_, along_;  // [m] distances from the origin at which the forces have kinks
};

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
