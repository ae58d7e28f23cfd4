// Tests that the loop keeps the LeverLoad contract: inputs, timing, and limits.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/device/pushing_hand.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr std::int64_t kLoadPeriodNs = 1'000'000;

// A load that returns a given output and records its inputs.
class ScriptedLoad final : public LeverLoad {
 public:
  LeverOutput step(const LeverInput& in, double period) noexcept override {
    last = in;
    periods.push_back(period);
    return answer;
  }
  const char* replay_parameters() const noexcept override { return "scripted"; }

  LeverOutput answer;
  LeverInput last;
  std::vector<double> periods;
};

SimulatedRunConfig starting_in(const Gate& gate, int gear) {
  SimulatedRunConfig config;
  config.gate = gate;
  config.start = rest_position(gate, gear);
  config.haptics.guard.ramp_time = 0.01;
  return config;
}

// Shifts from neutral into `gear` with the hand kGripHand. Returns true if the gear engages.
bool shifts_into(const Gate& gate, int gear, ScriptedLoad& load) {
  SimulatedRunConfig config = starting_in(gate, kNeutralGear);
  config.lever.hand = kGripHand;
  const int gears[] = {gear};
  ScriptedHand driver(touring_hand(config.start), shift_strokes(gate, config.start, gears), 0.001);
  SimulatedRun run(config, driver, &load);
  bool engaged = false;
  while (run.time() < driver.duration()) engaged = run.step().gear == gear || engaged;
  return engaged;
}

}  // namespace

TEST_CASE("the load's clock: first call 0, then one period, plus the skipped ones after an overrun") {
  const Gate gate = paper_gate();
  IdleHand idle_hand;
  SimulatedLever lever({}, kLoadPeriodNs, idle_hand);
  ScriptedLoad load;
  LoopInputs inputs;
  HapticLoop loop(HapticConfig{}, gate, lever, load, inputs);
  loop.cycle(0, 0);
  loop.cycle(1 * kLoadPeriodNs, 0);
  loop.cycle(4 * kLoadPeriodNs, 2);
  loop.cycle(5 * kLoadPeriodNs, 0);
  REQUIRE(load.periods.size() == 4);
  CHECK(load.periods[0] == 0.0);
  CHECK(load.periods[1] == doctest::Approx(0.001));
  CHECK(load.periods[2] == doctest::Approx(0.003));
  CHECK(load.periods[3] == doctest::Approx(0.001));
}

TEST_CASE("the load gets slot, depth and gear of the proxy, and the driver's controls") {
  const Gate gate = paper_gate();
  IdleHand idle_hand;
  ScriptedLoad load;
  SimulatedRun run(starting_in(gate, 2), idle_hand, &load);
  DriverControls controls;
  controls.pedals.clutch = 0.7;
  run.inputs().controls.write(controls);
  for (int i = 0; i < 200; ++i) run.step();
  CHECK(load.last.gear == 2);
  CHECK(load.last.slot == slot_of_gear(gate, 2));
  CHECK(load.last.depth == doctest::Approx(std::abs(rest_position(gate, 2).y)).epsilon(0.01));
  CHECK(load.last.controls.pedals.clutch == 0.7);
}

TEST_CASE("the load's force reaches the lever: 2 N into the slot move it by 2 N / slope of the lock") {
  const Gate gate = paper_gate();
  IdleHand idle_hand;
  ScriptedLoad load;
  SimulatedRun run(starting_in(gate, 1), idle_hand, &load);
  for (int i = 0; i < 500; ++i) run.step();
  const double before = run.lever().true_position().y;
  load.answer.force = {0.0, -2.0};
  for (int i = 0; i < 500; ++i) run.step();
  CHECK(run.lever().true_position().y < before - 0.0004);  // 2 N move the lever by 0.7 mm against the lock's 3000 N/m
  CHECK(run.lever().true_position().y > before - 0.0012);
}

TEST_CASE("a blocking synchroniser is a hard wall, and the gear does not engage: both sides of the gate") {
  const Gate gate = paper_gate();
  for (const int gear : {3, 4}) {
    ScriptedLoad load;
    load.answer.limited_slot = slot_of_gear(gate, gear);
    load.answer.depth_max = 0.020;
    SimulatedRunConfig config = starting_in(gate, kNeutralGear);
    const double side = rest_position(gate, gear).y > 0.0 ? 1.0 : -1.0;
    PushingHand hand([side](double, dvec2) { return dvec2{0.0, side * 15.0}; });
    SimulatedRun run(config, hand, &load);
    double deepest = 0.0;
    for (int i = 0; i < 2000; ++i) deepest = std::max(deepest, std::abs(run.step().proxy.y));
    CHECK(deepest == doctest::Approx(0.020));
    CHECK(std::abs(run.lever().true_position().y) < 0.020 + 15.0 / 5000.0);
    CHECK(run.loop().snapshot().gear == kNeutralGear);
    load.answer.limited_slot = kNoSlot;  // synchronised
    for (int i = 0; i < 500; ++i) run.step();
    CHECK(run.loop().snapshot().gear == gear);
  }
}

TEST_CASE("a torque lock holds the gear against any pull that the device can make: both sides of the gate") {
  const Gate gate = paper_gate();
  for (const int gear : {3, 4}) {
    ScriptedLoad load;
    load.answer.limited_slot = slot_of_gear(gate, gear);
    load.answer.depth_min = 0.034;
    const double side = rest_position(gate, gear).y > 0.0 ? 1.0 : -1.0;
    PushingHand hand([side](double time, dvec2) { return dvec2{0.0, time > 0.2 ? -side * 25.0 : 0.0}; });
    SimulatedRun run(starting_in(gate, gear), hand, &load);
    for (int i = 0; i < 2000; ++i) {
      run.step();
      REQUIRE(std::abs(run.loop().snapshot().proxy.y) >= 0.034 - 1e-9);
    }
    CHECK(run.loop().snapshot().gear == gear);
    load.answer.limited_slot = kNoSlot;
    bool came_out = false;
    for (int i = 0; i < 500; ++i) came_out = run.step().gear != gear || came_out;
    CHECK(came_out);
  }
}

TEST_CASE("a limit that excludes the lever's position never moves the lever") {
  const Gate gate = paper_gate();
  IdleHand idle_hand;
  ScriptedLoad load;
  SimulatedRun run(starting_in(gate, 3), idle_hand, &load);
  for (int i = 0; i < 300; ++i) run.step();
  const dvec2 before = run.loop().snapshot().proxy;
  load.answer.limited_slot = slot_of_gear(gate, 3);
  load.answer.depth_max = 0.015;
  for (int i = 0; i < 3; ++i) run.step();
  CHECK(std::abs(run.loop().snapshot().proxy.y - before.y) < 0.0003);
  CHECK(run.loop().snapshot().gear == 3);
}

TEST_CASE("reverse is locked at 30 km/h and free at rest, in every gate that locks it by speed") {
  int guarded = 0;
  for (const std::string& name : shipped_names()) {
    const Gate gate = shipped_gate(name);
    const bool has_lock = std::any_of(gate.lockout.begin(), gate.lockout.begin() + gate.lockout_count,
                                      [](const Lockout& lockout) { return lockout.kind == LockoutKind::speed; });
    if (!has_lock) continue;
    CAPTURE(name);
    ++guarded;
    ScriptedLoad standing, driving;
    driving.answer.road_speed = 30.0 / 3.6;
    CHECK(shifts_into(gate, kReverseGear, standing));
    CHECK_FALSE(shifts_into(gate, kReverseGear, driving));
    CHECK(shifts_into(gate, 1, driving));
  }
  CHECK(guarded >= 5);
}

TEST_CASE("reverse with a push-down or lift-ring lockout is locked for a hand that uses neither") {
  for (const char* name : {"six_speed_r_left_up", "six_speed_r_left_down"}) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    ScriptedLoad load;
    CHECK(shifts_into(gate, kReverseGear, load));  // the scripted hand opens the lockouts
    SimulatedRunConfig config = starting_in(gate, kNeutralGear);
    config.lever.hand = kGripHand;
    const int gears[] = {kReverseGear};
    std::vector<HandStroke> strokes = shift_strokes(gate, config.start, gears);
    for (HandStroke& stroke : strokes) stroke.pressed_down = stroke.lifted = false;
    ScriptedHand driver(touring_hand(config.start), strokes, 0.001);
    SimulatedRun run(config, driver);
    while (run.time() < driver.duration()) REQUIRE(run.step().gear != kReverseGear);
  }
}

TEST_CASE("no direct 5 to R: straight down is locked, via neutral it is free") {
  const Gate gate = shipped_gate("five_speed_r_right_down");
  const dvec2 fifth = rest_position(gate, 5), reverse = rest_position(gate, kReverseGear);
  for (const bool with_detour : {false, true}) {
    SimulatedRunConfig config = starting_in(gate, 5);
    config.lever.hand = kGripHand;
    std::vector<HandStroke> strokes{{fifth, 0.2, 0.2, {}, false, false}, {{fifth.x, 0.0}, 0.4, 0.2, {}, false, false}};
    if (with_detour) strokes.push_back({{0.0, 0.0}, 0.4, 0.2, {}, false, false});
    if (with_detour) strokes.push_back({{fifth.x, 0.0}, 0.4, 0.2, {}, false, false});
    strokes.push_back({reverse, 0.4, 0.4, {}, false, false});
    ScriptedHand driver(touring_hand(fifth), strokes, 0.001);
    SimulatedRun run(config, driver);
    bool engaged = false;
    while (run.time() < driver.duration()) engaged = run.step().gear == kReverseGear || engaged;
    CHECK(engaged == with_detour);
  }
}
