// Tests that the forces of the mechanism have a potential, are continuous, and match the paper and real gearboxes.
#include "haptics/gate/gate_feel.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/gate/gate_compiler.h"
#include "tests/haptics/gate/gate_laws.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

dvec2 random_free_point(const Gate& gate, std::mt19937_64& random) {
  std::uniform_real_distribution<double> x(gate.select_min, gate.select_max), y(-0.07, 0.07);
  for (;;) {
    const dvec2 p{x(random), y(random)};
    if (in_free_space(gate, p)) return p;
  }
}

// Independent computation of the force, by central differences of the energy.
dvec2 minus_gradient(const GateEnergy& energy, dvec2 p) {
  constexpr double h = 1e-7;
  return {(energy.at({p.x - h, p.y}) - energy.at({p.x + h, p.y})) / (2.0 * h),
          (energy.at({p.x, p.y - h}) - energy.at({p.x, p.y + h})) / (2.0 * h)};
}

}  // namespace

TEST_CASE("feel is the negative gradient of one energy, everywhere in every gate") {
  std::mt19937_64 random(7);
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const GateEnergy energy(gate);
    for (int i = 0; i < 20000; ++i) {
      const dvec2 p = random_free_point(gate, random);
      // Skips the aisle's edge, because two curves meet there and a central difference would mix them.
      if (std::abs(std::abs(p.y) - gate.half_aisle) < 1e-6) continue;
      REQUIRE(glm::distance(gate_feel(gate, p), minus_gradient(energy, p)) < 1e-4);
    }
  }
}

TEST_CASE("feel is continuous: no step larger than its largest slope allows") {
  const Gate gate = paper_gate();
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angle(0.0, 6.2831853);
  for (int i = 0; i < 100000; ++i) {
    const dvec2 p = random_free_point(gate, random);
    const double a = angle(random);
    const dvec2 q = p + 1e-6 * dvec2{std::cos(a), std::sin(a)};
    if (!in_free_space(gate, q)) continue;
    REQUIRE(glm::distance(gate_feel(gate, p), gate_feel(gate, q)) < 1e-6 * 20000.0);
  }
}

TEST_CASE("a lever is centred to the neutral column, and to the middle of the neutral aisle") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const double neutral = rest_position(gate, kNeutralGear).x;
    for (int i = 1; i < gate.column_count; ++i) {
      const double between = 0.5 * (column_of(gate, i - 1).center + column_of(gate, i).center);
      const double inward = gate_feel(gate, {between, 0.0}).x * (neutral - between);
      CHECK((name == "open_gate_six" ? inward == 0.0 : inward > 0.0));
      CHECK(gate_feel(gate, {between, 0.9 * gate.half_aisle}).y < 0.0);
      CHECK(gate_feel(gate, {between, -0.9 * gate.half_aisle}).y > 0.0);
    }
    CHECK(glm::length(gate_feel(gate, {neutral, 0.0})) < 1e-12);
  }
}

TEST_CASE("every gear is a stable rest position: no force there, pushed back from both sides") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    for (const Slot& slot : slots(gate)) {
      CAPTURE(gear_name(slot.gear));
      CHECK(std::abs(feel_force(slot.feel, slot.rest)) < 1e-9);
      CHECK(feel_force(slot.feel, slot.rest - 0.001) > 0.2);
      CHECK(feel_force(slot.feel, slot.end) < 0.0);
      CHECK(slot.release_depth < slot.engage_depth);
      CHECK(slot.engage_depth < slot.rest);
    }
  }
}

TEST_CASE("pulling out of a gear takes the lock's force, from the layout file") {
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  const Gate gate = compile_gate(layout, kPaperWorkspace);
  for (const Slot& slot : slots(gate)) {
    constexpr int kSteps = 20000;
    double max_force = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double depth = slot.rest + (slot.release_depth - slot.rest) * i / kSteps;
      max_force = std::max(max_force, feel_force(slot.feel, depth));
    }
    CHECK(max_force == doctest::Approx(layout.feel.lock_force).epsilon(1e-6));
  }
}

TEST_CASE("paper, Fig. 7 (c): in the buffer of junctions I and III a vertical force turns the lever") {
  const Gate gate = paper_gate();
  REQUIRE(gate.buffer_count == 2);
  for (const Buffer& buffer : buffers(gate)) {
    const double half = 0.5 * gate.half_aisle;
    const double inside = buffer.wall + 0.1 * (buffer.inner - buffer.wall);
    CHECK(gate_feel(gate, {inside, half}).y > 0.5);
    CHECK(gate_feel(gate, {inside, -half}).y < -0.5);
    // Outside the buffer nothing pushes the lever away from the centre line of the aisle.
    const double outside = buffer.inner + 0.001 * (buffer.inner > buffer.wall ? 1.0 : -1.0);
    CHECK(gate_feel(gate, {outside, half}).y <= 0.0);
  }
}

TEST_CASE("a buffer never holds a free lever: centring is stronger than its pull to the closed wall") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const double neutral = rest_position(gate, kNeutralGear).x;
    for (const Buffer& buffer : buffers(gate)) {
      for (int i = 0; i <= 100; ++i) {
        const double x = buffer.inner + 0.01 * i * (buffer.wall - buffer.inner);
        for (int j = -30; j <= 30; ++j) {
          REQUIRE(gate_feel(gate, {x, 0.05 * j * gate.half_aisle}).x * (neutral - x) > 0.0);
        }
      }
    }
  }
}

TEST_CASE("the largest feel stiffness is the steepest restoring slope found along all curves") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    constexpr double kStep = 1e-6;
    double stiffest = 0.0;
    const auto walk = [&](const FeelCurve& curve, double from, double to) {
      const int steps = static_cast<int>((to - from) / kStep);
      for (int i = 0; i < steps; ++i) {
        const double at = from + i * kStep;
        stiffest = std::max(stiffest, (feel_force(curve, at) - feel_force(curve, at + kStep)) / kStep);
      }
    };
    walk(gate.select_feel, gate.select_min, gate.select_max);
    walk(gate.aisle_feel, 0.0, gate.half_aisle);
    for (const Slot& slot : slots(gate)) walk(slot.feel, 0.0, slot.end);
    CHECK(max_feel_stiffness(gate) == doctest::Approx(stiffest).epsilon(1e-4));
  }
}
