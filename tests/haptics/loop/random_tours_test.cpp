// Tests in which a hand shifts through randomly generated gates.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "app/lab/random_gates/random_layout.h"
#include "app/lab/random_gates/random_mechanism.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

TEST_CASE("100 random gates, at various rates and delays: every gear, in order, and nothing left or broken") {
  constexpr double kRates[] = {250.0, 500.0, 1000.0, 1000.0, 2000.0};
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    SimulatedRunConfig config;
    config.gate = compile_gate(random_layout(seed), kPaperWorkspace);
    config.haptics.rate = kRates[seed % 5];
    config.lever.delay = static_cast<int>(seed / 5 % 3);
    config.lever.hand = kGripHand;  // kArmHand would oscillate (its own damping ratio: 0.13) and might miss a slot
    config.start = rest_position(config.gate, kNeutralGear);
    const std::vector<int> wanted = tour_order(config.gate);
    ScriptedHand driver(touring_hand(config.start), shift_strokes(config.gate, config.start, wanted),
                        1.0 / config.haptics.rate);
    SimulatedRun run(config, driver);
    EventLog events;
    while (run.time() < driver.duration()) {
      const HapticSnapshot& now = run.step();
      REQUIRE(in_free_space(config.gate, now.proxy, 1e-9));
      REQUIRE(now.fault == GuardFault::none);
      REQUIRE(std::abs(now.commanded.x) <= 31.7);
      REQUIRE(std::abs(now.commanded.y) <= 31.7);
      events.see(run.loop());
    }
    CHECK(events.engaged_gears() == wanted);
  }
}

// An after-gear lockout makes the hand pass a point half-way between two columns. If the columns are close together,
// this point is nearly in front of the slot, but the hand must not yet shift there.
TEST_CASE("a hand is in front of a slot before it shifts into it: 500 random gates, every gear after every other") {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    CAPTURE(seed);
    const Gate gate = compile_gate(random_layout(seed), kPaperWorkspace);
    std::vector<int> gears;
    for (const Slot& from : slots(gate))
      for (const Slot& to : slots(gate))
        for (const int gear : {from.gear, to.gear})
          if (gears.empty() || gears.back() != gear) gears.push_back(gear);
    dvec2 at = rest_position(gate, kNeutralGear);
    std::size_t next = 0;
    for (const HandStroke& stroke : shift_strokes(gate, at, gears)) {
      if (std::abs(stroke.to.y) > gate.half_aisle + gate.chamfer) {
        const Slot& slot = slot_of(gate, slot_of_gear(gate, gears[next++]));
        const Column& column = column_of(gate, slot.column);
        CHECK(std::abs(at.x - column.center) <= column.half_width + 0.0015 + 1e-9);
      }
      at = stroke.to;
    }
  }
}

TEST_CASE("120 random trees and grids of oblique aisles: a hand reaches every place in order, and nothing breaks") {
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    CAPTURE(seed);
    SimulatedRunConfig config;
    config.gate = compile_gate(random_mechanism(seed), kPaperWorkspace);
    config.lever.hand = kGripHand;
    config.start = rest_position(config.gate, kNeutralGear);
    const std::vector<int> wanted = tour_order(config.gate);
    ScriptedHand driver(touring_hand(config.start), shift_strokes(config.gate, config.start, wanted),
                        1.0 / config.haptics.rate);
    SimulatedRun run(config, driver);
    EventLog events;
    while (run.time() < driver.duration() + 0.5) {  // a soft hand may need more time for its last detent
      const HapticSnapshot& now = run.step();
      REQUIRE(in_free_space(config.gate, now.proxy, 1e-9));
      REQUIRE(now.fault == GuardFault::none);
      events.see(run.loop());
    }
    // A detent may throw the lever past the next place and back, so other places in between are allowed.
    auto next = wanted.begin();
    for (const int gear : events.engaged_gears())
      if (next != wanted.end() && *next == gear) ++next;
    CHECK(next == wanted.end());
  }
}
