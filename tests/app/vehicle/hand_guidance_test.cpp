// Tests that the guidance force is the gradient of a bounded potential, leads to the gear in every gate, and is zero
// when guidance is off.
#include "app/vehicle/hand_guidance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/contact/proxy.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using glm::dvec2;

namespace {

// Calls `check` for every gear of every shipped gate.
void for_each_goal(auto&& check) {
  for (const std::string& name : shipped_names()) {
    const Gate gate = shipped_gate(name);
    for (const Slot& slot : slots(gate)) {
      CAPTURE(name);
      CAPTURE(std::string(gear_name(slot.gear)));
      check(gate, slot.gear);
    }
  }
}

std::vector<dvec2> free_points(const Gate& gate, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(gate.select_min, gate.select_max), y(-0.05, 0.05);
  std::vector<dvec2> points;
  while (static_cast<int>(points.size()) < count) {
    const dvec2 p{x(random), y(random)};
    if (in_free_space(gate, p)) points.push_back(p);
  }
  return points;
}

// The potential's formula in hand_guidance.h, with its parts from first principles: S' = v (3 - v^2) / 2 within the
// rounding and 1 beyond it, integrated; B and W by the cubic that has zero slope at both ends.
double guidance_energy(const Gate& gate, int gear, dvec2 p) {
  const Slot& slot = slot_of(gate, slot_of_gear(gate, gear));
  const Column& goal = column_of(gate, slot.column);
  const Column& here = column_of(gate, nearest_column(gate, p.x));
  const double soft = goal.half_width;
  const auto s = [&](double u) {
    const double inside = std::min(std::abs(u), soft);
    return 0.75 * inside * inside / soft - 0.125 * std::pow(inside, 4) / std::pow(soft, 3) + std::abs(u) - inside;
  };
  const auto step = [](double u, double width) {
    const double v = std::clamp(u / width, 0.0, 1.0);
    return 3.0 * v * v - 2.0 * v * v * v;
  };
  double gap = 1.0;  // [m] from the edge of the gear's column to that of the next one
  for (const Column& other : columns(gate)) {
    if (&other == &goal) continue;
    gap = std::min(gap, std::abs(other.center - goal.center) - other.half_width - goal.half_width);
  }
  if (gap == 1.0) gap = gate.select_max - gate.select_min;
  const double across = s(p.x - goal.center);
  const double b = step(std::abs(p.y) - gate.half_aisle, 2.0 * soft);
  const double w = 1.0 - step(std::abs(p.x - goal.center) - goal.half_width, gap);
  const double end = s(p.y - static_cast<int>(slot.side) * slot.rest) - slot.rest;
  return kGuidancePull * (across - b * (across - s(here.center - goal.center)) + (1.0 - w) * s(p.y) + w * end);
}

DriverControls asking(int gear, double guidance) {
  DriverControls controls;
  controls.guided_gear = gear;
  controls.guidance = guidance;
  return controls;
}

}  // namespace

TEST_CASE("the force is the negative gradient of the potential") {
  for_each_goal([](const Gate& gate, int gear) {
    constexpr double kStep = 1e-7;
    for (const dvec2 p : free_points(gate, 300, 1)) {
      const auto energy = [&](double dx, double dy) { return guidance_energy(gate, gear, p + dvec2{dx, dy}); };
      const dvec2 slope{(energy(kStep, 0) - energy(-kStep, 0)) / (2 * kStep),
                        (energy(0, kStep) - energy(0, -kStep)) / (2 * kStep)};
      CHECK(glm::length(guidance_force(gate, gear, p) + slope) < 1e-4);
    }
  });
}

TEST_CASE("no closed path through the gate yields energy, not even around corners and along walls") {
  for_each_goal([](const Gate& gate, int gear) {
    // The lever moves to random points; the proxy follows the lever and slides along the walls.
    std::mt19937 random(static_cast<unsigned>(gear + 5));
    std::uniform_real_distribution<double> x(-0.08, 0.08), y(-0.06, 0.06);
    const dvec2 start = rest_position(gate, kNeutralGear);
    Proxy proxy{start, start};
    double work = 0.0, max_work = 0.0;
    const auto go = [&](dvec2 to) {
      const dvec2 from = proxy.lever;
      for (int i = 1; i <= 400; ++i) {
        const dvec2 before = proxy.position;
        proxy = move_proxy(gate, open_passage(gate), proxy, from + (to - from) * (i / 400.0), 1e-3);
        const dvec2 step = proxy.position - before;
        // Integrates the work along each straight part of the path by Simpson's rule, in steps of at most 50 um.
        const int parts = 1 + static_cast<int>(glm::length(step) / 5e-5);
        for (int k = 0; k < parts; ++k) {
          const auto force = [&](double u) { return guidance_force(gate, gear, before + step * ((k + u) / parts)); };
          work += glm::dot(force(0.0) + 4.0 * force(0.5) + force(1.0), step) / (6.0 * parts);
        }
        max_work = std::max(max_work, std::abs(work));
      }
    };
    for (int n = 0; n < 30; ++n) go({x(random), y(random)});
    for (int n = 0; n < 4; ++n) go(start);
    CHECK(glm::distance(proxy.position, start) < 1e-9);
    CHECK(max_work > 0.01);  // [J] the guidance force did work during the motion
    CHECK(std::abs(work) < 2e-5);
  });
}

TEST_CASE("the force is bounded, and its slope is less than half of that allowed for the gate's feel") {
  for_each_goal([](const Gate& gate, int gear) {
    constexpr double kStep = 1e-6;
    for (const dvec2 p : free_points(gate, 2000, 2)) {
      const dvec2 force = guidance_force(gate, gear, p);
      CHECK(glm::length(force) <= 2.2 * kGuidancePull);
      for (const dvec2 d : {dvec2{kStep, 0.0}, dvec2{0.0, kStep}}) {
        CHECK(glm::length(guidance_force(gate, gear, p + d) - force) / kStep < 2000.0);
      }
    }
  });
}

TEST_CASE("deep in a slot the force does not push against the slot's walls, and it leads out of a wrong slot") {
  for_each_goal([](const Gate& gate, int gear) {
    for (const Slot& slot : slots(gate)) {
      const Column& column = column_of(gate, slot.column);
      for (double depth = gate.half_aisle + 2.0 * column.half_width; depth < slot.end; depth += 5e-4) {
        for (const double off : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
          const dvec2 p{column.center + off * column.half_width, static_cast<int>(slot.side) * depth};
          const dvec2 force = guidance_force(gate, gear, p);
          CHECK(std::abs(force.x) < 1e-12);
          if (slot.gear != gear) CHECK(static_cast<int>(slot.side) * force.y < -0.2 * kGuidancePull);
        }
      }
    }
  });
}

TEST_CASE("at the gear's rest position the force is zero and the potential has its minimum") {
  for_each_goal([](const Gate& gate, int gear) {
    const dvec2 rest = rest_position(gate, gear);
    CHECK(glm::length(guidance_force(gate, gear, rest)) < 1e-12);
    const double lowest = guidance_energy(gate, gear, rest);
    for (const dvec2 p : free_points(gate, 1000, 3)) CHECK(guidance_energy(gate, gear, p) > lowest);
  });
}

TEST_CASE("from every point, a lever moved only by the guidance force arrives at the gear") {
  for_each_goal([](const Gate& gate, int gear) {
    const dvec2 rest = rest_position(gate, gear);
    const double half_width = column_of(gate, nearest_column(gate, rest.x)).half_width;
    const auto has_arrived = [&](dvec2 p) {
      return std::abs(p.y - rest.y) < 1e-3 && std::abs(p.x - rest.x) <= half_width + 1e-9;
    };
    for (const dvec2 p : free_points(gate, 40, 4)) {
      Proxy proxy{p, p};
      for (int i = 0; i < 3000 && !has_arrived(proxy.position); ++i) {
        const dvec2 force = guidance_force(gate, gear, proxy.position);
        proxy.lever = proxy.position;
        proxy = move_proxy(gate, open_passage(gate), proxy, proxy.position + 1e-4 * force, 0.0);
      }
      CHECK(has_arrived(proxy.position));
    }
  });
}

TEST_CASE("without guidance there is no force; at half strength the force is half the full one") {
  const Gate gate = paper_gate();
  HandGuidance guidance(gate);
  for (const dvec2 p : free_points(gate, 200, 5)) CHECK(guidance.step(asking(3, 0.0), p, 1e-3) == dvec2{0.0, 0.0});
  dvec2 force;
  for (int i = 0; i < 1000; ++i) force = guidance.step(asking(1, 0.5), {0.01, 0.0}, 1e-3);
  CHECK(glm::distance(force, 0.5 * guidance_force(gate, 1, {0.01, 0.0})) < 1e-9);
  CHECK(glm::length(force) > 1.0);
}

TEST_CASE("the force rises and fades gradually for any sequence of requests") {
  const Gate gate = paper_gate();
  HandGuidance guidance(gate);
  std::mt19937 random(6);
  std::uniform_int_distribution<int> gear(-1, 9);
  std::uniform_real_distribution<double> strength(-0.5, 2.0);
  const dvec2 p{0.012, 0.001};
  dvec2 before{0.0};
  DriverControls controls = asking(3, 0.0);
  guidance.step(controls, p, 0.0);
  for (int i = 0; i < 20000; ++i) {
    if (i % 37 == 0) controls = asking(gear(random), strength(random));
    const dvec2 force = guidance.step(controls, p, 1e-3);
    CHECK(glm::length(force - before) <= kGuidanceRate * 1e-3 * 3.0 * kGuidancePull + 1e-12);
    before = force;
  }
  for (int i = 0; i < 600; ++i) guidance.step(asking(3, 0.0), p, 1e-3);
  CHECK(guidance.step(asking(3, 0.0), p, 1e-3) == dvec2{0.0, 0.0});
}

TEST_CASE("a gear that the gate lacks, neutral and non-finite input give no guidance force") {
  const Gate gate = paper_gate();
  CHECK(guidance_force(gate, 6, {0.0, 0.0}) == dvec2{0.0, 0.0});
  CHECK(guidance_force(gate, kNeutralGear, {0.01, 0.0}) == dvec2{0.0, 0.0});
  HandGuidance guidance(gate);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 100; ++i) CHECK(guidance.step(asking(1, nan), {0.01, 0.0}, 1e-3) == dvec2{0.0, 0.0});
  for (int i = 0; i < 100; ++i) guidance.step(asking(1, 1.0), {0.01, 0.0}, 1e-3);
  CHECK(guidance.step(asking(1, 1.0), {nan, 0.0}, 1e-3) == dvec2{0.0, 0.0});
}
