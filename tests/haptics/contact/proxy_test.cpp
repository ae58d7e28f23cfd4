// The proxy never leaves free space, never jumps across a wall and never generates energy.
#include "haptics/contact/proxy.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/gate/gate_feel.h"
#include "tests/haptics/gate/gate_laws.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kSlack = 1e-9;       // [m]
constexpr double kHandOver = 0.5e-3;  // [m] `hand_over` of move_proxy(): extra travel of the proxy per cycle, at 1 kHz
constexpr double kStiffness = 5000.0;

dvec2 random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> x(-0.09, 0.09), y(-0.08, 0.08);
  return {x(random), y(random)};
}

// The next lever position: usually a small step away, sometimes a jump across the whole gate.
dvec2 wander(dvec2 lever, std::mt19937_64& random) {
  std::normal_distribution<double> step(0.0, 0.002);
  if (random() % 200 == 0) return random_point(random);
  const dvec2 next{lever.x + step(random), lever.y + step(random)};
  return {std::clamp(next.x, -0.09, 0.09), std::clamp(next.y, -0.08, 0.08)};
}

// A smooth closed path through the gate and beyond its walls: a sum of harmonics with random amplitudes.
class ClosedPath {
 public:
  explicit ClosedPath(std::mt19937_64& random) {
    std::normal_distribution<double> amplitude(0.0, 0.022);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    for (int k = 1; k <= 4; ++k) {
      const double fade = 1.0 / k;
      terms_.push_back(
          {static_cast<double>(k), fade * amplitude(random), phase(random), fade * amplitude(random), phase(random)});
    }
    offset_ = {amplitude(random), 0.5 * amplitude(random)};
  }
  dvec2 at(double s) const {
    dvec2 p = offset_;
    for (const Term& t : terms_) {
      p.x += t.ax * std::sin(2.0 * std::numbers::pi * t.k * s + t.px);
      p.y += t.ay * std::sin(2.0 * std::numbers::pi * t.k * s + t.py);
    }
    return p;
  }

 private:
  struct Term {
    double k, ax, px, ay, py;
  };
  std::vector<Term> terms_;
  dvec2 offset_{0.0};
};

}  // namespace

TEST_CASE("a million random steps and throws never leave the free space; the other shipped gates 200,000 each") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    std::mt19937_64 random(1);
    Proxy proxy = place_proxy(gate, {0.0, 0.0});
    dvec2 lever{0.0};
    const int steps = name == "paper" ? 1'000'000 : 200'000;
    for (int i = 0; i < steps; ++i) {
      lever = wander(lever, random);
      proxy = move_proxy(gate, open_passage(gate), proxy, lever, kHandOver);
      REQUIRE(in_free_space(gate, proxy.position, kSlack));
    }
  }
}

TEST_CASE("a lever in the free space of the proxy's aisle coincides with its proxy: no force without a wall") {
  const Gate gate = paper_gate();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-1e-3, 1e-3);
  for (int i = 0; i < 100'000; ++i) {
    const dvec2 a = random_point(random);
    const dvec2 b = a + dvec2{jitter(random), jitter(random)};
    if (!in_free_space(gate, a) || !in_free_space(gate, b)) continue;
    const Proxy proxy = move_proxy(gate, open_passage(gate), {a, a}, b, kHandOver);
    REQUIRE(glm::distance(proxy.position, b) < 1e-12);
  }
}

TEST_CASE("a throw from one slot to another in one sample leaves the proxy in its slot") {
  const Gate gate = paper_gate();
  for (const int from : {1, 2, 3, 4, 5, kReverseGear}) {
    for (const int to : {1, 2, 3, 4, 5, kReverseGear}) {
      const dvec2 a = rest_position(gate, from), b = rest_position(gate, to);
      if (a.x == b.x) continue;  // the same column: no wall lies between the points
      const Proxy proxy = move_proxy(gate, open_passage(gate), {a, a}, b, kHandOver);
      CAPTURE(from);
      CAPTURE(to);
      if (a.y * b.y > 0.0) CHECK(slot_at(gate, proxy.position) == slot_of_gear(gate, from));
      CHECK(slot_at(gate, proxy.position) != slot_of_gear(gate, to));
    }
  }
}

TEST_CASE("two walls at once: in a slot's corner the proxy is the corner") {
  const Gate gate = paper_gate();
  const Slot& slot = gate.slot[static_cast<std::size_t>(slot_of_gear(gate, 1))];
  const Column& column = gate.column[static_cast<std::size_t>(slot.column)];
  const int side = static_cast<int>(slot.side);
  const dvec2 corner{column.center + column.half_width, side * slot.end};
  Proxy proxy{rest_position(gate, 1), rest_position(gate, 1)};
  for (int i = 1; i <= 20; ++i) {
    const dvec2 lever = rest_position(gate, 1) + dvec2{0.001 * i, side * 0.001 * i};
    proxy = move_proxy(gate, open_passage(gate), proxy, lever, kHandOver);
  }
  CHECK(glm::distance(proxy.position, corner) < 1e-12);
}

TEST_CASE("grazing a junction's corner: from a nanometre inside to a nanometre outside nothing jumps") {
  const Gate gate = paper_gate();
  for (const Column& column : {gate.column[0], gate.column[1], gate.column[2]}) {
    for (int step = -6; step <= 6; ++step) {
      const double graze = 0.5e-9 * step;
      Proxy proxy{{column.center - 0.015, 0.0}, {column.center - 0.015, 0.0}};
      if (!in_free_space(gate, proxy.position)) continue;
      for (int i = -1500; i <= 1500; ++i) {
        const dvec2 lever{column.center + 1e-5 * i, gate.half_aisle + graze};
        proxy = move_proxy(gate, open_passage(gate), proxy, lever, 5e-6);
        REQUIRE(in_free_space(gate, proxy.position, kSlack));
        if (lever.x < gate.select_max) REQUIRE(glm::distance(proxy.position, lever) < 4e-9);
      }
    }
  }
}

TEST_CASE("when the governing wall changes the force changes by at most K (2 |step| + hand-over)") {
  const Gate gate = paper_gate();
  std::mt19937_64 random(4);
  Proxy proxy;
  dvec2 lever{0.0};
  double max_change = 0.0;
  for (int i = 0; i < 500'000; ++i) {
    const dvec2 before = lever - proxy.position;
    const dvec2 next = wander(lever, random);
    const double step = glm::distance(next, lever);
    lever = next;
    proxy = move_proxy(gate, open_passage(gate), proxy, lever, kHandOver);
    const double change = kStiffness * glm::distance(lever - proxy.position, before);
    REQUIRE(change <= kStiffness * (2.0 * step + kHandOver) + 1e-9);
    if (step < 2e-4) max_change = std::max(max_change, change);
  }
  CHECK(max_change > 1.0);  // the run must include large changes of force
}

// The work along a path is computed from the forces only (trapezoid rule, 0.2 um steps). The energy that is still
// stored in the coupling spring and in the gate's potential is added, so the limit of 1e-9 J must hold all along the path
// (checked every 20 um).
TEST_CASE("kinematic closed paths give back at most 1e-9 J of position-only work") {
  for (const std::string& name : {std::string("paper"), std::string("dog_leg_five")}) {
    const Gate gate = shipped_gate(name);
    const GateEnergy energy(gate);
    std::mt19937_64 random(5);
    const double scale = std::min(1.0, kStiffness / max_feel_stiffness(gate));
    for (int trial = 0; trial < (is_full_campaign() ? 12 : 3); ++trial) {
      CAPTURE(trial);
      const ClosedPath path(random);
      const int steps = 1'500'000;
      Proxy proxy = place_proxy(gate, path.at(0.0));
      const auto force = [&](dvec2 lever) {
        return kStiffness * (proxy.position - lever) + scale * gate_feel(gate, proxy.position);
      };
      const auto stored = [&](dvec2 lever) {
        const dvec2 d = lever - proxy.position;
        return 0.5 * kStiffness * glm::dot(d, d) + scale * energy.at(proxy.position) -
               scale * glm::dot(gate_feel(gate, proxy.position), d);
      };
      dvec2 lever = path.at(0.0);
      dvec2 last = force(lever);
      const double at_start = stored(lever);
      double work = 0.0, worst = -1.0;
      for (int i = 1; i <= steps; ++i) {
        const dvec2 next = path.at(static_cast<double>(i) / steps);
        proxy = move_proxy(gate, open_passage(gate), proxy, next, 2e-7);
        const dvec2 now = force(next);
        work += glm::dot(0.5 * (last + now), next - lever);
        lever = next;
        last = now;
        if (i % 100 == 0) worst = std::max(worst, work + stored(lever) - at_start);
      }
      CHECK(worst <= 1e-9);
    }
  }
}

TEST_CASE("a closed slot is a wall at its mouth, and a limit of depth is a wall: on both sides of the gate") {
  const Gate gate = paper_gate();
  for (const int gear : {5, kReverseGear}) {
    const int slot = slot_of_gear(gate, gear);
    const dvec2 goal = rest_position(gate, gear), mouth{goal.x, 0.0};
    const auto pushed = [&](const Passage& passage, dvec2 from, dvec2 to) {
      Proxy proxy{from, from};
      for (int i = 0; i <= 100; ++i)
        proxy = move_proxy(gate, passage, proxy, from + (to - from) * (i / 100.0), kHandOver);
      return std::abs(proxy.position.y);
    };
    Passage closed = open_passage(gate);
    closed.closed = 1u << slot;
    CHECK(pushed(closed, mouth, goal) == doctest::Approx(gate.half_aisle + gate.chamfer));
    Passage blocked = open_passage(gate);
    blocked.limited_slot = slot;
    blocked.depth_max = 0.020;
    CHECK(pushed(blocked, mouth, goal) == doctest::Approx(0.020));
    Passage locked = open_passage(gate);  // a torque lock: the lever cannot leave the gear
    locked.limited_slot = slot;
    locked.depth_min = 0.030;
    locked.depth_max = 1.0;
    CHECK(pushed(locked, goal, mouth) == doctest::Approx(0.030));
  }
}

TEST_CASE("a free lever is exactly its proxy: rounding causes no contact") {
  const Gate gate = paper_gate();
  Proxy proxy;
  std::mt19937_64 random(6);
  std::normal_distribution<double> step(0.0, 1e-13);
  dvec2 lever{0.0};
  for (int i = 0; i < 10000; ++i) {
    lever += dvec2{step(random), step(random)};
    proxy = move_proxy(gate, open_passage(gate), proxy, lever, kHandOver);
    REQUIRE(proxy.position == lever);
  }
}

TEST_CASE("a lever position that is not finite moves nothing") {
  const Gate gate = paper_gate();
  const Proxy proxy{{0.01, 0.0}, {0.01, 0.0}};
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(move_proxy(gate, open_passage(gate), proxy, {bad, 0.0}, kHandOver).position == proxy.position);
    CHECK(move_proxy(gate, open_passage(gate), proxy, {0.0, bad}, kHandOver).position == proxy.position);
  }
}
