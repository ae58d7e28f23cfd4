// The rules that proxy and feel must keep in random trees and grids of oblique aisles.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lab/random_gates/random_mechanism.h"
#include "haptics/contact/free_span.h"
#include "haptics/contact/proxy.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// [m] distance of a point from a segment, by its own formula
double segment_distance(dvec2 p, dvec2 a, dvec2 b) {
  const dvec2 d = b - a;
  const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::length(p - a - t * d);
}

// [m] how far the point is outside the union of the layout's aisles; negative inside
double outside(const GateLayout& layout, dvec2 p) {
  double least = HUGE_VAL;
  for (const AisleLayout& a : layout.aisles)
    least = std::min(least, segment_distance(p, {a.from_x, a.from_y}, {a.to_x, a.to_y}) - a.width / 2.0);
  return least;
}

struct Walk {
  explicit Walk(std::uint64_t seed)
      : layout(random_mechanism(seed)), gate(compile_gate(layout, kPaperWorkspace)), random(seed) {
    proxy = place_proxy(gate, {x(random), y(random)});
    lever = proxy.position;
  }

  void step_lever() {
    lever = random() % 100 == 0 ? dvec2{x(random), y(random)} : lever + dvec2{step(random), step(random)};
    lever = {std::clamp(lever.x, -0.08, 0.08), std::clamp(lever.y, -0.07, 0.07)};
  }

  GateLayout layout;
  Gate gate;
  std::mt19937_64 random;
  std::normal_distribution<double> step{0.0, 0.002};
  std::uniform_real_distribution<double> x{-0.08, 0.08}, y{-0.07, 0.07};
  Proxy proxy;
  dvec2 lever{0.0};
};

// Work [J] of the gate's force along the line from a to b, by Simpson's rule in steps of at most 5 um.
double work(const Gate& gate, dvec2 a, dvec2 b) {
  const int steps = 1 + static_cast<int>(glm::distance(a, b) / 5e-6);
  const dvec2 d = (b - a) / static_cast<double>(steps);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const dvec2 from = a + static_cast<double>(i) * d;
    sum += glm::dot(gate_feel(gate, from) + 4.0 * gate_feel(gate, from + 0.5 * d) + gate_feel(gate, from + d), d) / 6.0;
  }
  return sum;
}

}  // namespace

TEST_CASE("200 random mechanisms: a million steps and throws, lockouts at random, never outside, never a jump") {
  int aisles_seen = 0, locked = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Walk walk(seed);
    const Gate& gate = walk.gate;
    aisles_seen += gate.aisle_count;
    Lockouts lockouts;
    LockoutInputs in;
    Passage last = open_passage(gate);
    for (int i = 0; i < 5000; ++i) {
      const dvec2 lever_before = walk.lever, before = walk.proxy.position;
      walk.step_lever();
      const bool turns_knob = walk.random() % 50 == 0, turns_ring = walk.random() % 50 == 0;
      if (turns_knob) in.pressed_down = !in.pressed_down;
      if (turns_ring) in.lifted = !in.lifted;
      const Passage passage = lockouts.update(gate, in, before);
      if (!turns_knob && !turns_ring) {  // a lever that presses on a lockout does not open it
        REQUIRE((last.closed & ~passage.closed) == 0);
        if (last.held_slot != kNoSlot) REQUIRE(passage.held_slot == last.held_slot);
      }
      last = passage;
      walk.proxy = move_proxy(gate, passage, walk.proxy, walk.lever, 0.5e-3);
      const dvec2 now = walk.proxy.position;
      REQUIRE(outside(walk.layout, now) <= 1e-9);
      REQUIRE(glm::distance(walk.lever, now) <= glm::distance(walk.lever, before) + 1e-12);
      REQUIRE(glm::distance(now, before) <= glm::distance(walk.lever, lever_before) + 0.5e-3 + 1e-12);
      for (int k = 0; k < gate.slot_count; ++k) {
        const Slot& place = slot_of(gate, k);
        const bool was_in = slot_at(gate, before) == k;
        if ((passage.closed >> k & 1u) != 0 && !was_in && slot_at(gate, now) == k) {
          ++locked;
          REQUIRE(glm::distance(now, place.at) >= 0.85 * place.end - 1e-9);
        }
        if (passage.held_slot == k) {
          ++held;
          REQUIRE(glm::distance(now, place.at) <= std::max(0.5 * place.end, 0.0055) + 1e-9);
        }
      }
    }
  }
  CHECK(aisles_seen > 600);
  CHECK(locked > 100);
  CHECK(held > 100);
}

TEST_CASE("in random mechanisms, the forces' work on a way depends only on its ends, and the force never jumps") {
  double most = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Walk walk(seed);
    const Gate& gate = walk.gate;
    const Passage open = open_passage(gate);
    // Goes out in free space by the proxy's moves, and home again: through the same aisles, but by other points.
    const dvec2 home = rest_position(gate, kNeutralGear);
    const double stiffest = 2.0 * max_feel_stiffness(gate) + 2.0 * 4000.0;
    for (int loop = 0; loop < 10; ++loop) {
      Proxy proxy{home, home};
      double sum = 0.0, energy_scale = 0.0;  // [J] work; sum of its magnitudes
      const auto go = [&](dvec2 lever) {
        double step = 0.2e-3;  // [m] halved where the straight line to the next point would cut a corner of the walls
        for (int leg = 0; leg < 1000; ++leg) {
          const dvec2 before = proxy.position;
          const dvec2 next = move_proxy(gate, open, {before, lever}, lever, step).position;
          if (next == before) return;
          bool cuts = false;
          for (double part = 0.1; part < 0.95; part += 0.1)
            cuts |= outside(walk.layout, glm::mix(before, next, part)) > 1e-10;
          if (cuts && step > 1e-10) {
            step *= 0.25;
            continue;
          }
          step = 0.2e-3;
          proxy.position = next;
          const double done = work(gate, before, next);
          sum += done;
          energy_scale += std::abs(done);
          const dvec2 jump = gate_feel(gate, next) - gate_feel(gate, before);
          REQUIRE(glm::length(jump) <= stiffest * glm::distance(next, before) + 1e-6);
        }
      };
      for (int i = 0; i < 30; ++i) go({walk.x(walk.random), walk.y(walk.random)});
      const dvec2 away = proxy.position;
      const double out = sum;
      // The work from home to `away` again, by a second random way; whatever it is, it must be the same.
      proxy = {home, home};
      sum = 0.0;
      for (int i = 0; i < 4000 && glm::distance(proxy.position, away) > 1e-6; ++i)
        go(i % 3 == 2 ? away : dvec2{walk.x(walk.random), walk.y(walk.random)});
      if (glm::distance(proxy.position, away) > 1e-6) continue;  // it never came by
      sum += work(gate, proxy.position, away);                   // the last micrometre
      most = std::max(most, std::abs(sum - out) / energy_scale);
      REQUIRE(std::abs(sum - out) <= 1e-9);  // [J] as in H gates
    }
  }
  MESSAGE("largest difference, as a fraction of all work done: ", most);
}

// The span in each direction ends where a walk in steps of 10 um along the axis would leave the union of aisles.
TEST_CASE("in random mechanisms, the free span along both axes is what a walk in small steps finds") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Walk walk(seed);
    for (int i = 0; i < 30; ++i) {
      const dvec2 p = place_proxy(walk.gate, {walk.x(walk.random), walk.y(walk.random)}).position;
      const FreeSpan span = free_span(walk.gate, open_passage(walk.gate), p);
      for (int axis = 0; axis < 2; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
          const double reach = sign * ((sign > 0.0 ? span.high : span.low)[axis] - p[axis]);
          REQUIRE(reach >= -1e-9);
          dvec2 q = p;
          for (double s = 0.0; s < reach; s += 10e-6) {
            q[axis] = p[axis] + sign * s;
            REQUIRE(outside(walk.layout, q) < 1e-9);
          }
          q[axis] = p[axis] + sign * (reach + 2e-6);
          REQUIRE(outside(walk.layout, q) > -1e-9);
        }
      }
    }
  }
}

// Two parallel aisles joined at one end: the lever is thrown from the far end of one to the far end of the other.
TEST_CASE("a thrown lever leaves the proxy behind the wall between two parallel aisles") {
  const char* kText =
      "name = \"U\"\n"
      "[[aisle]]\nfrom_x_mm = -8\nfrom_y_mm = 30\nto_x_mm = -8\nto_y_mm = -30\n"
      "[[aisle]]\nfrom_x_mm = -8\nfrom_y_mm = -30\nto_x_mm = 8\nto_y_mm = -30\n"
      "[[aisle]]\nfrom_x_mm = 8\nfrom_y_mm = -30\nto_x_mm = 8\nto_y_mm = 30\n"
      "[[place]]\nx_mm = -8\ny_mm = 30\nneutral = true\n"
      "[[place]]\nlabel = \"A\"\nx_mm = 8\ny_mm = 30\n";
  const Gate gate = compile_gate(parse_gate_layout(kText, "u.toml"), kPaperWorkspace);
  Proxy proxy = place_proxy(gate, {-0.008, 0.030});
  for (int i = 0; i < 1000; ++i) proxy = move_proxy(gate, open_passage(gate), proxy, {0.008, 0.030}, 0.5e-3);
  CHECK(proxy.position.x == doctest::Approx(-0.003));
  CHECK(proxy.position.y == doctest::Approx(0.030));
}
