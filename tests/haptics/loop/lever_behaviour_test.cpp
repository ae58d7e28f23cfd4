// Tests of the gate as a hand feels it, on the simulated lever with complete haptic cycles.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/device/pushing_hand.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

SimulatedRunConfig resting_at(const Gate& gate, dvec2 start) {
  SimulatedRunConfig config;
  config.gate = gate;
  config.start = start;
  config.haptics.guard.ramp_time = 0.01;
  return config;
}

HapticSnapshot run_for(SimulatedRun& run, double seconds, EventLog* events = nullptr) {
  for (const double end = run.time() + seconds; run.time() < end;) {
    run.step();
    if (events != nullptr) events->see(run.loop());
  }
  return run.loop().snapshot();
}

}  // namespace

TEST_CASE("row 11: a free lever away from the gears returns to the neutral position by itself") {
  IdleHand idle_hand;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-0.035, 0.035), y(-0.02, 0.02);
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const dvec2 neutral = rest_position(gate, kNeutralGear);
    for (int trial = 0; trial < (is_full_campaign() ? 40 : 12);) {
      const dvec2 start{x(random), y(random)};
      const double before_crest = gate.half_aisle + gate.chamfer + 0.001;
      if (!in_free_space(gate, start) || std::abs(start.y) > before_crest) continue;
      ++trial;
      CAPTURE(start.x);
      CAPTURE(start.y);
      SimulatedRun run(resting_at(gate, start), idle_hand);
      const HapticSnapshot end = run_for(run, 3.0);
      CHECK(glm::distance(end.lever, neutral) < 0.001);  // not 0, because the handle's spring moves the lever slightly
      CHECK(end.gear == kNeutralGear);
    }
  }
}

TEST_CASE("row 10: a released lever stays in gear: no ejection, no drift within a minute") {
  IdleHand idle_hand;
  const Gate gate = paper_gate();
  for (const int gear : {1, 2, 3, 4, 5, kReverseGear}) {
    SimulatedRun run(resting_at(gate, rest_position(gate, gear)), idle_hand);
    const HapticSnapshot early = run_for(run, 1.0);
    const HapticSnapshot late = run_for(run, 60.0);
    CHECK(late.gear == gear);
    CHECK(glm::distance(early.lever, late.lever) < 0.0002);
  }
}

TEST_CASE("row 10 at every rate and delay: a bare lever comes to rest in gear, within two counts of the encoder") {
  IdleHand idle_hand;
  const Gate gate = paper_gate();
  for (const double rate : {100.0, 200.0, 300.0, 333.0, 500.0, 1000.0, 2000.0, 4000.0}) {
    for (int delay = 0; delay <= 3; ++delay) {
      CAPTURE(rate);
      CAPTURE(delay);
      for (const int gear : {1, 4}) {
        const dvec2 rest = rest_position(gate, gear);
        SimulatedRunConfig config = resting_at(gate, {rest.x, rest.y - std::copysign(0.001, rest.y)});
        config.haptics.rate = rate;
        config.lever.delay = delay;
        SimulatedRun run(config, idle_hand);
        run_for(run, 4.0);
        double low = 1.0, high = -1.0;
        for (const double end = run.time() + 0.5; run.time() < end;) {
          run.step();
          low = std::min(low, run.lever().true_position().y);
          high = std::max(high, run.lever().true_position().y);
        }
        CHECK(high - low < 0.00016);
        // At rates that admit less than a tenth of the gate's feel forces, the handle's spring can pull the lever out
        // of gear.
        if (run.loop().admitted().tuning.feel_scale >= 0.1) CHECK(run.loop().snapshot().gear == gear);
      }
    }
  }
}

TEST_CASE("row 10: the pull that disengages a gear is the lock's force plus the handle's spring, within 3 %") {
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  const Gate gate = compile_gate(layout, kPaperWorkspace);
  for (const int gear : {1, 2, 3, 4}) {
    const double away = rest_position(gate, gear).y > 0.0 ? -1.0 : 1.0;
    double pull = 0.0;
    PushingHand hand([&](double time, dvec2) {
      pull = 2.0 * std::max(0.0, time - 0.2);  // 2 N/s, so slow that the lever stays in balance
      return dvec2{0.0, away * pull};
    });
    SimulatedRun run(resting_at(gate, rest_position(gate, gear)), hand);
    run_for(run, 0.1);
    REQUIRE(run.loop().snapshot().gear == gear);
    while (run.time() < 20.0 && run.step().gear == gear) continue;
    // The handle's spring of 15.7 N/m (the paper's equation (12)) helps the pull. The lock is strongest at about 30 mm.
    const Slot& slot = slot_of(gate, slot_of_gear(gate, gear));
    double strongest_at = slot.rest;
    for (int i = 0; i <= 1000; ++i) {
      const double s = slot.rest - 1e-3 * i * (slot.rest - slot.release_depth);
      if (feel_force(slot.feel, s) > feel_force(slot.feel, strongest_at)) strongest_at = s;
    }
    const double expected = layout.feel.lock_force - kPaperAxisY.stiffness * strongest_at;
    CHECK(pull == doctest::Approx(expected).epsilon(0.03));
  }
}

TEST_CASE("row 12: a steady push along the aisle ends at the speed where damping balances it, within 3 %") {
  // Without feel forces along the neutral aisle, only damping acts on the lever there.
  Gate gate = paper_gate();
  gate.select_feel = {};
  gate.buffer_count = 0;
  SimulatedRunConfig config = resting_at(gate, {-0.034, 0.0});
  config.lever.axis_x.stiffness = 0.0;
  config.lever.axis_x.mass = 0.005;  // so light that it reaches its final speed within the aisle
  config.haptics.tuning.limit_damping = 1.0;
  config.haptics.tuning.aisle_damping = 0.5;
  for (const double push : {2.0, 4.0}) {
    PushingHand hand([&](double time, dvec2) { return dvec2{time > 0.02 ? push : 0.0, 0.0}; });
    SimulatedRun run(config, hand);
    while (run.lever().true_position().x < 0.030 && run.time() < 1.0) run.step();
    const double reached = run.lever().true_velocity().x;
    const HapticTuning used = run.loop().admitted().tuning;
    const double b = config.lever.axis_x.damping + used.aisle_damping;
    const double slow = push / b;
    const double expected =
        slow <= used.speed_limit ? slow : (push + used.limit_damping * used.speed_limit) / (b + used.limit_damping);
    CHECK(reached == doctest::Approx(expected).epsilon(0.03));
  }
}

TEST_CASE("row 9: pushed along the neutral aisle into junctions I and III, the lever is turned the way it leans") {
  const Gate gate = paper_gate();
  for (const double direction : {-1.0, 1.0}) {
    for (const double lean : {-1.0, 1.0}) {
      PushingHand hand([&](double, dvec2) { return dvec2{direction * 8.0, lean * 0.05}; });
      SimulatedRunConfig config = resting_at(gate, {0.0, lean * 0.0005});
      config.haptics.tuning.feel_scale = 1.0;
      SimulatedRun run(config, hand);
      const HapticSnapshot end = run_for(run, 2.0);
      CAPTURE(direction);
      CAPTURE(lean);
      CHECK(direction * end.proxy.x > 0.03);
      CHECK(lean * end.lever.y > 0.5 * gate.half_aisle);
    }
  }
}

TEST_CASE("eq (4): f_j = f_h - f_a is what moves the joystick: m a + b v + k x (eqs 11, 12)") {
  const Gate gate = paper_gate();
  PushingHand hand([](double time, dvec2) { return dvec2{6.0 * std::sin(9.0 * time), 1.5 * std::cos(7.0 * time)}; });
  SimulatedRunConfig config = resting_at(gate, {0.0, 0.0});
  config.lever.force_sensor.resolution_gw = 0.0;
  SimulatedRun run(config, hand);
  dvec2 v0{0.0}, v1{0.0}, x1{0.0}, f1{0.0};  // one period earlier
  double squares = 0.0;
  int samples = 0;
  for (int i = 0; i < 3000; ++i) {
    const HapticSnapshot& s = run.step();
    REQUIRE(glm::distance(s.f_j, s.f_h - s.f_a) < 1e-12);
    const dvec2 v2 = run.lever().true_velocity();
    const dvec2 a1 = (v2 - v0) / (2.0 * run.period());
    const dvec2 expected{kPaperAxisX.mass * a1.x + kPaperAxisX.damping * v1.x + kPaperAxisX.stiffness * x1.x,
                         kPaperAxisY.mass * a1.y + kPaperAxisY.damping * v1.y + kPaperAxisY.stiffness * x1.y};
    // Force and acceleration change only between periods. `expected` neglects that the lever's tip moves on an arc, so
    // only positions within 20 mm of the centre are compared. At 20 mm the neglect causes an error of about 3 % of the
    // force.
    if (i > 10 && glm::length(x1) < 0.02) {
      squares += glm::dot(f1 - expected, f1 - expected);
      ++samples;
    }
    v0 = v1;
    v1 = v2;
    x1 = run.lever().true_position();
    f1 = s.f_j;
  }
  REQUIRE(samples > 500);
  CHECK(std::sqrt(squares / samples) < 0.25);  // [N] forces reach 10 N; a wrong sign of `f_a` would cause several N
}

TEST_CASE("eq (4) in a long push against a wall: f_h is the push, and f_a is the push minus the handle's spring") {
  const Gate gate = paper_gate();
  const dvec2 start{0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
  PushingHand hand([](double, dvec2) { return dvec2{0.0, 20.0}; });
  SimulatedRunConfig config = resting_at(gate, start);
  config.lever.force_sensor.resolution_gw = 0.0;
  SimulatedRun run(config, hand);
  run_for(run, 0.5);
  dvec2 f_h{0.0}, f_a{0.0};
  for (int i = 0; i < 200; ++i) {
    f_h += run.step().f_h / 200.0;
    f_a += run.loop().snapshot().f_a / 200.0;
  }
  CHECK(f_h.y == doctest::Approx(20.0).epsilon(0.01));
  CHECK(f_a.y == doctest::Approx(20.0 - kPaperAxisY.stiffness * run.lever().true_position().y).epsilon(0.01));
}

TEST_CASE("row 13: a push above 60 N warns once, clears below 50 N, and saturation is reported") {
  const Gate gate = paper_gate();
  const double wall = -1.0;  // direction in y of the neutral aisle's lower wall
  const dvec2 start{0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
  PushingHand hand([&](double time, dvec2) {
    const double tremble = 4.0 * std::sin(60.0 * time);
    return dvec2{0.0, wall * (time < 0.5 ? 20.0 : time < 1.0 ? 62.0 + tremble : time < 1.5 ? 57.0 + tremble : 20.0)};
  });
  SimulatedRun run(resting_at(gate, start), hand);
  EventLog events;
  run_for(run, 0.45, &events);
  CHECK((run.loop().snapshot().flags & (kFlagOverPush | kFlagSaturated)) == 0);
  run_for(run, 0.5, &events);
  CHECK((run.loop().snapshot().flags & kFlagOverPush) != 0);
  CHECK((run.loop().snapshot().flags & kFlagSaturated) != 0);
  run_for(run, 1.5, &events);
  CHECK((run.loop().snapshot().flags & (kFlagOverPush | kFlagSaturated)) == 0);
  const std::vector<HapticEvent> begins = events.of(EventKind::over_push_begin);
  const std::vector<HapticEvent> ends = events.of(EventKind::over_push_end);
  REQUIRE(begins.size() == 1);
  REQUIRE(ends.size() == 1);
  CHECK(begins[0].value > 60.0);
  CHECK(ends[0].value < 50.0);
  CHECK(events.count(EventKind::saturation_begin) >= 1);
}

TEST_CASE(
    "row 14: the drawn lever stays inside while the hand is far outside, and past 20 mm the ghost is asked "
    "for") {
  Gate gate = paper_gate();
  gate.select_feel = {};  // no sideways forces, so the lever moves straight into the wall
  const dvec2 start{0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
  PushingHand hand([](double time, dvec2) { return dvec2{0.0, time < 0.02 ? 0.0 : 60.0}; });
  SimulatedRun run(resting_at(gate, start), hand);
  EventLog events;
  double deepest = 0.0;
  bool ghost = false;
  while (run.time() < 1.0) {
    const HapticSnapshot& s = run.step();
    events.see(run.loop());
    REQUIRE(in_free_space(gate, s.proxy, 1e-9));
    const double depth = glm::distance(s.lever, s.proxy);
    REQUIRE(((s.flags & kFlagGhost) != 0) == (depth > 0.020));
    ghost = ghost || (s.flags & kFlagGhost) != 0;
    deepest = std::max(deepest, depth);
  }
  CHECK(ghost);
  // As in the paper, the wall collapses: the motors give at most 31.7 N against the hand's 60 N, so the bare lever runs
  // to its stop at 35 degrees.
  CHECK(deepest == doctest::Approx(0.12 * std::sin(35.0 * 3.14159265 / 180.0) - gate.half_aisle).epsilon(0.01));
  CHECK(events.count(EventKind::wall_contact) >= 1);
}

TEST_CASE(
    "row 13 without a force sensor: the warning uses the push estimated from saturation and displacement, and says "
    "so") {
  class Blind final : public HapticDevice {
   public:
    explicit Blind(SimulatedLever& lever) : lever_(lever), spec_(lever.spec()) { spec_.measures_hand_force = false; }
    const DeviceSpec& spec() const noexcept override { return spec_; }
    LeverReading read(std::int64_t now_ns) noexcept override {
      LeverReading reading = lever_.read(now_ns);
      reading.hand_force = {0.0, 0.0};
      return reading;
    }
    void write(dvec2 force) noexcept override { lever_.write(force); }
    void release() noexcept override { lever_.release(); }

   private:
    SimulatedLever& lever_;
    DeviceSpec spec_;
  };
  Gate gate = paper_gate();
  gate.select_feel = {};
  for (const double push : {25.0, 70.0}) {
    CAPTURE(push);
    PushingHand hand([push](double time, dvec2) { return dvec2{0.0, push * std::min(1.0, 2.0 * time)}; });
    SimulatedLever lever({}, 1'000'000, hand);
    lever.place({0.5 * (gate.column[0].center + gate.column[1].center), 0.0});
    Blind blind(lever);
    NoLoad load;
    LoopInputs inputs;
    HapticConfig config;
    config.guard.ramp_time = 0.01;
    HapticLoop loop(config, gate, blind, load, inputs);
    loop.arm();
    EventLog events;
    for (int i = 0; i < 1000; ++i) {
      loop.cycle(i * std::int64_t{1'000'000}, 0);
      events.see(loop);
    }
    CHECK((loop.snapshot().flags & kFlagPushEstimated) != 0);
    CHECK((events.count(EventKind::over_push_begin) > 0) == (push > 60.0));
  }
}

TEST_CASE("saturation is reported when the motors overheat: commanded but not delivered") {
  const Gate gate = paper_gate();
  for (const int delay : {0, 2}) {
    PushingHand hand([](double, dvec2) { return dvec2{0.0, 13.0}; });  // above the continuous force of 10.83 N
    SimulatedRunConfig config = resting_at(gate, {0.5 * (gate.column[0].center + gate.column[1].center), 0.0});
    config.lever.actuator.overload_time = 0.02;
    config.lever.delay = delay;
    SimulatedRun run(config, hand);
    EventLog events;
    run_for(run, 8.0, &events);
    CHECK(events.count(EventKind::saturation_begin) >= 1);
  }
}

TEST_CASE("a wall contact event has the impact speed") {
  const Gate gate = paper_gate();
  const dvec2 start{0.5 * (gate.column[0].center + gate.column[1].center), -0.9 * gate.half_aisle};
  PushingHand hand([](double time, dvec2) { return dvec2{0.0, time < 0.1 ? 0.0 : 6.0}; });
  SimulatedRun run(resting_at(gate, start), hand);
  EventLog events;
  double speed = 0.0, before = 0.0;
  while (run.time() < 1.0 && events.count(EventKind::wall_contact) == 0) {
    run.step();
    events.see(run.loop());
    before = std::exchange(speed, run.lever().true_velocity().y);
  }
  const std::vector<HapticEvent> contacts = events.of(EventKind::wall_contact);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].value == doctest::Approx(before).epsilon(0.25));  // tolerance: the speed is smoothed over 4 ms
}
