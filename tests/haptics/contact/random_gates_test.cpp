// The rules that the proxy must keep, tested on random gates with movable walls that open and close at random.
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lab/random_gates/random_layout.h"
#include "haptics/contact/proxy.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

LockoutInputs random_inputs(std::mt19937_64& random, LockoutInputs in) {
  if (random() % 50 == 0) in.pressed_down = !in.pressed_down;
  if (random() % 50 == 0) in.lifted = !in.lifted;
  if (random() % 50 == 0) in.road_speed = static_cast<double>(random() % 10);
  if (random() % 50 == 0) in.gear = static_cast<int>(random() % 7) - 1;
  return in;
}

}  // namespace

TEST_CASE("200 random gates: a million steps and throws, walls opening and closing, never outside, never through") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const Gate gate = compile_gate(random_layout(seed), kPaperWorkspace);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> step(0.0, 0.002);
    std::uniform_real_distribution<double> x(-0.08, 0.08), y(-0.07, 0.07);
    Lockouts lockouts;
    LockoutInputs in;
    Proxy proxy = place_proxy(gate, {x(random), y(random)});
    dvec2 lever = proxy.position;
    for (int i = 0; i < 5000; ++i) {
      lever = random() % 100 == 0 ? dvec2{x(random), y(random)} : lever + dvec2{step(random), step(random)};
      lever = {std::clamp(lever.x, -0.08, 0.08), std::clamp(lever.y, -0.07, 0.07)};
      in = random_inputs(random, in);
      const dvec2 before = proxy.position;
      const Passage passage = lockouts.update(gate, in, before);
      proxy = move_proxy(gate, passage, proxy, lever, 0.5e-3);
      REQUIRE(in_free_space(gate, proxy.position, 1e-9));
      REQUIRE(glm::distance(lever, proxy.position) <= glm::distance(lever, before) + 1e-12);
      // The proxy neither crosses a closed lateral wall nor enters a closed slot.
      REQUIRE(proxy.position.x <= std::max(passage.select_max, before.x) + 1e-9);
      REQUIRE(proxy.position.x >= std::min(passage.select_min, before.x) - 1e-9);
      const int slot = slot_at(gate, proxy.position);
      const bool entered = slot != kNoSlot && slot_at(gate, before) != slot;
      if (entered && (passage.closed >> slot & 1u) != 0) {
        REQUIRE(std::abs(proxy.position.y) <= gate.half_aisle + gate.chamfer + 1e-9);
      }
    }
  }
}
