// Compares the half-sample hold with the exact integral that it approximates.
#include "haptics/contact/virtual_coupling.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kCouplingPeriod = 0.001;
constexpr double kProxyStep = 0.5e-3;

// Wall force at the upper wall of the neutral aisle, midway between two columns, where the wall is flat.
double wall_force(const Gate& gate, const Coupling& coupling, double depth, double speed) {
  const double x = 0.5 * (gate.column[0].center + gate.column[1].center);
  const Proxy proxy{{x, std::min(gate.half_aisle, gate.half_aisle + depth)}, {x, gate.half_aisle + depth}};
  LeverMotion motion;
  motion.position = {x, gate.half_aisle + depth};
  motion.velocity = {0.0, speed};
  return -contact_force(coupling, gate, open_passage(gate), proxy, motion).force.y;
}

// Mean spring force over the next period, integrated numerically as the reference for the half-sample hold.
double mean_spring_force(double stiffness, double depth, double speed, double horizon) {
  const int n = 200000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += std::max(0.0, depth + speed * horizon * (i + 0.5) / n);
  return stiffness * sum / n;
}

}  // namespace

TEST_CASE("the held force is the mean spring force of the coming period: inside, entering and leaving") {
  const Gate gate = paper_gate();
  const Coupling spring{5000.0, 0.0, kCouplingPeriod};
  const struct {
    double depth, speed;
  } cases[] = {{1e-3, 0.0},  {1e-3, 0.3},    {2e-3, -0.5},   {-0.1e-3, 0.3}, {-0.29e-3, 0.3},
               {-1e-3, 0.5}, {0.1e-3, -0.3}, {0.2e-3, -1.0}, {0.3e-3, -0.3}, {-0.2e-3, 1.0}};
  for (const auto& c : cases) {
    CAPTURE(c.depth);
    CAPTURE(c.speed);
    const double expected = mean_spring_force(5000.0, c.depth, c.speed, kCouplingPeriod);
    CHECK(wall_force(gate, spring, c.depth, c.speed) == doctest::Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("inside the wall the hold is a damper of KT/2: Minsky's 0.5 (paper eq 22)") {
  const Gate gate = paper_gate();
  const Coupling spring{5000.0, 0.0, kCouplingPeriod};
  const double still = wall_force(gate, spring, 2e-3, 0.0), moving = wall_force(gate, spring, 2e-3, 0.1);
  CHECK((moving - still) / 0.1 == doctest::Approx(5000.0 * kCouplingPeriod / 2.0));
}

TEST_CASE("a wall never pulls, however fast the lever leaves it") {
  const Gate gate = paper_gate();
  const Coupling coupling{5000.0, 20.0, kCouplingPeriod};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> depth(0.0, 5e-3), speed(-20.0, 20.0);
  for (int i = 0; i < 10000; ++i) REQUIRE(wall_force(gate, coupling, depth(random), speed(random)) >= 0.0);
}

TEST_CASE("damping acts along the wall's normal only: sliding along a wall is not damped") {
  const Gate gate = paper_gate();
  const double x = 0.5 * (gate.column[0].center + gate.column[1].center);
  const Proxy proxy{{x, gate.half_aisle}, {x, gate.half_aisle + 0.001}};
  LeverMotion motion;
  motion.position = {x, gate.half_aisle + 0.001};
  motion.velocity = {0.5, 0.0};
  const dvec2 force = contact_force({5000.0, 20.0, kCouplingPeriod}, gate, open_passage(gate), proxy, motion).force;
  CHECK(std::abs(force.x) < 1e-9);
  CHECK(force.y == doctest::Approx(-5.0));
}

TEST_CASE("damping adds B v inside the wall") {
  const Gate gate = paper_gate();
  const double spring = wall_force(gate, {5000.0, 0.0, kCouplingPeriod}, 2e-3, 0.1);
  CHECK(wall_force(gate, {5000.0, 12.0, kCouplingPeriod}, 2e-3, 0.1) - spring == doctest::Approx(12.0 * 0.1));
}

TEST_CASE("round a mouth's corner at rest the force changes by at most K times the hand-over per cycle") {
  const Gate gate = paper_gate();
  const Column& column = gate.column[1];
  const Coupling coupling{5000.0, 10.0, kCouplingPeriod};
  Proxy proxy{{column.center - 0.012, gate.half_aisle}, {column.center - 0.012, gate.half_aisle + 0.005}};
  dvec2 before{0.0, -25.0};
  double max_change = 0.0;
  for (int um = -12000; um < 12000; ++um) {  // 1 mm/s
    LeverMotion motion;
    motion.position = {column.center + 1e-6 * um, gate.half_aisle + 0.005};
    proxy = move_proxy(gate, open_passage(gate), proxy, motion.position, kProxyStep);
    const dvec2 now = contact_force(coupling, gate, open_passage(gate), proxy, motion).force;
    max_change = std::max(max_change, glm::distance(now, before));
    before = now;
  }
  CHECK(max_change <= 5000.0 * (2e-6 + kProxyStep) + 1e-9);
  CHECK(max_change > 1.0);
}

TEST_CASE("no force in free space unless the lever is about to reach a wall") {
  const Gate gate = paper_gate();
  const Coupling coupling{5000.0, 10.0, kCouplingPeriod};
  CHECK(wall_force(gate, coupling, -1e-3, 0.9) == 0.0);
  CHECK(wall_force(gate, coupling, -1e-3, -5.0) == 0.0);
}
