// Tests in which a hand shifts through every gear of every gate, with complete haptic cycles and without a window.
#include <algorithm>
#include <initializer_list>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

struct TourResult {
  std::vector<int> engaged;
  bool inside = true;    // the proxy never left the free space
  double deepest = 0.0;  // [m] largest distance of the lever from its proxy
  double fastest = 0.0;  // [m/s]
};

TourResult drive(const Gate& gate, const HandImpedance& hand, double rate) {
  SimulatedRunConfig config;
  config.haptics.rate = rate;
  config.lever.hand = hand;
  config.gate = gate;
  const dvec2 start = rest_position(gate, kNeutralGear);
  ScriptedHand driver(touring_hand(start), shift_strokes(gate, start, tour_order(gate)), 1.0 / rate);
  SimulatedRun run(config, driver);
  TourResult result;
  EventLog events;
  for (double end = driver.duration(); run.time() < end;) {
    const HapticSnapshot& now = run.step();
    events.see(run.loop());
    result.inside = result.inside && in_free_space(gate, now.proxy, 1e-9);
    result.deepest = std::max(result.deepest, glm::distance(now.lever, now.proxy));
    result.fastest = std::max(result.fastest, glm::length(run.lever().true_velocity()));
  }
  result.engaged = events.engaged_gears();
  return result;
}

}  // namespace

TEST_CASE("the hand drives every gear of every shipped gate, each once and in order") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const TourResult tour = drive(gate, kGripHand, 1000.0);
    CHECK(tour.engaged == tour_order(gate));
    CHECK(tour.inside);
    CHECK(tour.deepest < 0.007);  // [m] at 7 mm, the hand would press with 35 N on the wall of 5000 N/m
  }
}

TEST_CASE("paper, Fig. 9: neutral, 1 to 5, reverse, with every hand that can move a lever") {
  const Gate gate = paper_gate();
  for (const HandImpedance& hand : {kLightHand, kGripHand, kArmHand}) {
    CAPTURE(hand.mass);
    CHECK(drive(gate, hand, 1000.0).engaged == std::vector<int>{1, 2, 3, 4, 5, kReverseGear});
  }
}

TEST_CASE("the paper's tour at 100 Hz to 4 kHz") {
  const Gate gate = paper_gate();
  for (const double rate : {100.0, 200.0, 500.0, 2000.0, 4000.0}) {
    CAPTURE(rate);
    CHECK(drive(gate, kGripHand, rate).engaged == std::vector<int>{1, 2, 3, 4, 5, kReverseGear});
  }
}
