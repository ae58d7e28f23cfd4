// Tests of device walls, which the device renders in addition to the loop's walls. They are in the right places, never
// obstruct a free lever, and do not throw the hand when they change while the device still has the old walls.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "app/lab/bench/lever/pressed_rig.h"
#include "app/lab/random_gates/random_layout.h"
#include "haptics/device/pushing_hand.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/haptic_loop.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// A simulated lever with device walls, which records the walls that the loop sends.
class RecordingLever final : public HapticDevice {
 public:
  RecordingLever(const SimulatedLeverConfig& config, HandDriver& hand) : lever(config, kPeriodNs, hand) {}
  const DeviceSpec& spec() const noexcept override { return claimed_spec; }
  LeverReading read(std::int64_t now_ns) noexcept override { return lever.read(now_ns); }
  void write(dvec2 force) noexcept override { lever.write(force); }
  void set_device_walls(const LeverWalls& walls) noexcept override {
    sent_walls = walls;
    ++times;
    lever.set_device_walls(walls);
  }
  void release() noexcept override { lever.release(); }

  SimulatedLever lever;
  DeviceSpec claimed_spec = lever.spec();
  LeverWalls sent_walls;
  int times = 0;
};

RecordingLever lever_claiming(const SimulatedLeverConfig& config, HandDriver& hand, double device_wall_damping) {
  RecordingLever lever(config, hand);
  lever.claimed_spec.device_wall_damping = dvec2(device_wall_damping);
  return lever;
}

struct Rig {
  Rig(const SimulatedLeverConfig& lever, HandDriver& hand, const Gate& at = paper_gate(), HapticConfig config = {},
      double device_wall_damping = 0.0)
      : gate(at), device(lever_claiming(lever, hand, device_wall_damping)), loop(config, gate, device, load, inputs) {}
  void run(int cycles, std::int64_t skipped = 0) {
    for (int i = 0; i < cycles; ++i) loop.cycle(now += kPeriodNs * (1 + skipped), skipped);
  }
  const HapticSnapshot& out() const { return loop.snapshot(); }

  Gate gate;
  RecordingLever device;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop;
  std::int64_t now = 0;
};

SimulatedLeverConfig lever_of(double own, int delay, const HandImpedance& hand = kBareHand) {
  SimulatedLeverConfig config;
  config.device_wall_stiffness = own;
  config.delay = delay;
  config.hand = hand;
  return config;
}

// A hand that moves to random points, through walls if necessary, with every lockout open and an additional push in
// changing directions.
class WanderingHand final : public HandDriver {
 public:
  explicit WanderingHand(std::uint64_t seed) : random_(seed) {}
  HandTarget next(double time, dvec2) noexcept override {
    if (time >= end_) {
      from_ = to_;
      to_ = {random_within(0.06), random_within(0.055)};
      begin_ = time;
      end_ = time + std::max(0.05, glm::distance(from_, to_) / 0.4);
    }
    HandTarget target = minimum_jerk(from_, to_, time - begin_, end_ - begin_);
    target.push = 5.0 * dvec2{std::sin(7.0 * time), std::cos(5.0 * time)};
    target.pressed_down = target.lifted = true;
    return target;
  }

 private:
  double random_within(double max) { return max * (2.0 * static_cast<double>(random_() >> 11) * 0x1p-53 - 1.0); }

  std::mt19937_64 random_;
  dvec2 from_{0.0}, to_{0.0};
  double begin_ = 0.0, end_ = 0.0;
};

bool contains(const LeverWalls& walls, dvec2 p) {
  return glm::all(glm::lessThanEqual(walls.low, p)) && glm::all(glm::lessThanEqual(p, walls.high));
}

}  // namespace

TEST_CASE("the device gets its walls, and again when they change; their fraction follows the guard's ramp") {
  IdleHand idle_hand;
  Rig none(lever_of(0.0, 0), idle_hand);
  none.loop.arm();
  none.run(1000);
  CHECK(none.device.times == 0);

  Rig rig(lever_of(400.0, 0), idle_hand);
  rig.run(10);
  CHECK(rig.device.times == 0);  // idle
  rig.loop.arm();
  rig.run(250);
  CHECK(rig.device.sent_walls.stiffness_fraction == doctest::Approx(0.5));
  CHECK(rig.device.times == 250);
  rig.run(300);
  CHECK(rig.device.sent_walls.stiffness_fraction == 1.0);
  CHECK(rig.device.times == 500);  // sent once per cycle of the 0.5 s ramp, but not afterwards at rest
  const Column& column = rig.gate.column[static_cast<std::size_t>(rig.gate.neutral_column)];
  CHECK(rig.device.sent_walls.high == dvec2{rig.gate.select_max, column.forward});
  CHECK(rig.device.sent_walls.low == dvec2{rig.gate.select_min, column.back});
}

TEST_CASE("the device gets its part of the wall damping, following the guard's ramp; the loop damps the rest") {
  IdleHand idle_hand;
  HapticConfig config;
  config.tuning.wall_damping = 10.0;
  for (const auto& [own, fraction] : {std::pair{4.0, 1.0}, {40.0, 0.25}}) {
    Rig rig(lever_of(0.0, 0), idle_hand, paper_gate(), config, own);
    rig.loop.arm();
    rig.run(250);
    CHECK(rig.device.sent_walls.damping_fraction == doctest::Approx(0.5 * fraction));
    rig.run(300);
    CHECK(rig.device.sent_walls.damping_fraction == fraction);
    CHECK(rig.device.sent_walls.stiffness_fraction == 0.0);                // the device has no springs
    rig.loop.change_tuning({.wall_stiffness = 0.0, .wall_damping = 0.0});  // a stiff wall needs damping
    rig.run(2);
    CHECK(rig.device.sent_walls.damping_fraction == 0.0);
  }
}

TEST_CASE("every way out of running removes the device walls in the same cycle") {
  const auto falls = [](auto make_it_fall, GuardState to) {
    IdleHand idle_hand;
    Rig rig(lever_of(400.0, 2), idle_hand);
    rig.loop.arm();
    rig.run(600);
    REQUIRE(rig.device.sent_walls.stiffness_fraction == 1.0);
    make_it_fall(rig);
    CHECK(rig.out().guard == to);
    CHECK(rig.device.sent_walls.stiffness_fraction == 0.0);
  };
  const auto command = [](LoopCommand what) {
    return [what](Rig& rig) {
      rig.inputs.commands.push(what);
      rig.run(1);
    };
  };
  falls(command(LoopCommand::stop), GuardState::released);
  falls(command(LoopCommand::disarm), GuardState::idle);
}

TEST_CASE("too many overruns remove the device walls, and they return with the ramp") {
  IdleHand idle_hand;
  Rig rig(lever_of(400.0, 2), idle_hand);
  rig.loop.arm();
  rig.run(600);
  rig.run(8, 1);
  CHECK(rig.out().guard == GuardState::damped);
  CHECK(rig.device.sent_walls.stiffness_fraction == 0.0);
  rig.run(52);
  CHECK(rig.out().guard == GuardState::ramping);
  CHECK(rig.device.sent_walls.stiffness_fraction > 0.0);
  CHECK(rig.device.sent_walls.stiffness_fraction < 0.01);
}

TEST_CASE("20 N into a wall with 3 samples of delay: the device's part is added to the loop's admitted part") {
  for (const double own : {0.0, 400.0, 1000.0, 3000.0}) {
    CAPTURE(own);
    PushingHand hand([](double time, dvec2) { return dvec2{0.0, std::min(20.0, 20.0 * time)}; });
    HapticConfig config;
    config.contact.hold = ContactHold::half_sample;
    Rig rig(lever_of(own, 3), hand, plain_aisle(0.06, 0.01), config);
    rig.loop.arm();
    rig.run(3000);
    double depth = 0.0;
    for (int i = 0; i < 100; ++i) {
      rig.run(1);
      depth += (rig.device.lever.true_position().y - rig.gate.half_aisle) / 100.0;
    }
    const double by_wall = 20.0 - kPaperAxisY.stiffness * (rig.gate.half_aisle + depth);
    CHECK(by_wall / depth == doctest::Approx(rig.out().wall_stiffness).epsilon(0.03));
    CHECK(rig.out().wall_stiffness <= own + 0.25 * 0.086 / 16e-6);  // device's part + loop's limit 0.25 mass / (4 ms)^2
    // On stiffer springs the late half-sample hold would add energy, so the device renders the wall alone.
    CHECK(rig.out().wall_stiffness >= own + (own > 0.35 * 0.086 / 16e-6 ? 0.0 : 1000.0));
    CHECK(rig.out().f_a.y == doctest::Approx(by_wall).epsilon(0.03));
  }
}

TEST_CASE("a wall softer than the device's is rendered partly by the device and not by the loop") {
  PushingHand hand([](double time, dvec2) { return dvec2{0.0, std::min(5.0, 5.0 * time)}; });
  HapticConfig config;
  config.tuning.wall_stiffness = 600.0;
  Rig rig(lever_of(1000.0, 3), hand, plain_aisle(0.06, 0.01), config);
  rig.loop.arm();
  rig.run(3000);
  CHECK(rig.device.sent_walls.stiffness_fraction == doctest::Approx(0.6));
  CHECK(rig.out().wall_force == dvec2{0.0, 0.0});
  const double depth = rig.device.lever.true_position().y - rig.gate.half_aisle;
  CHECK((5.0 - kPaperAxisY.stiffness * (rig.gate.half_aisle + depth)) / depth == doctest::Approx(600.0).epsilon(0.03));
}

// The walls are sent for the lever's future position, predicted from its smoothed speed. Until the walls act, the
// prediction is wrong by at most a (tau^2 / 2 + s tau), with acceleration a, smoothing time s = 4 ms and tau = (delay +
// 1) periods. A free lever can be that far inside a wall of 1000 N/m.
TEST_CASE("the free span always contains the proxy, and a free lever hardly feels walls that reach the device late") {
  for (const int delay : {0, 3, 8}) {
    double strongest = 0.0;     // [N] force of the device walls on a lever outside all walls
    double acceleration = 0.0;  // [m/s^2] maximum
    for (std::uint64_t seed = 1; seed <= (is_full_campaign() ? 20u : 5u); ++seed) {
      CAPTURE(delay);
      CAPTURE(seed);
      WanderingHand hand(seed);
      Rig rig(lever_of(1000.0, delay, kGripHand), hand, compile_gate(random_layout(seed), kPaperWorkspace));
      rig.loop.arm();
      std::vector<LeverWalls> sent_walls;
      for (int i = 0; i < 5000; ++i) {
        const dvec2 before = rig.device.lever.true_velocity();
        rig.run(1);
        acceleration = std::max(acceleration, 1e3 * glm::distance(rig.device.lever.true_velocity(), before));
        sent_walls.push_back(rig.device.sent_walls);
        if (rig.device.sent_walls.stiffness_fraction == 0.0) continue;
        REQUIRE(contains(rig.device.sent_walls, rig.out().proxy));
        if ((rig.out().flags & kFlagContact) != 0 || i <= delay) continue;
        const LeverWalls& acts = sent_walls[static_cast<std::size_t>(i - delay - 1)];
        const dvec2 there = rig.out().lever;
        strongest = std::max(strongest, 1000.0 * glm::distance(there, glm::clamp(there, acts.low, acts.high)));
      }
    }
    MESSAGE("delay " << delay << ": a free lever felt " << strongest << " N of the device's walls at most");
    const double tau = 1e-3 * (delay + 1.0);
    CHECK(strongest < 1000.0 * acceleration * (0.5 * tau + 0.004) * tau);
  }
}

TEST_CASE("when walls change, a hand moves no faster than on a lever without delay and without device walls") {
  const auto fastest = [](double own, int delay, const HandImpedance& hand) {
    double max_speed = 0.0;
    for (std::uint64_t seed = 1; seed <= (is_full_campaign() ? 8u : 3u); ++seed) {
      WanderingHand wanders(seed);
      Rig rig(lever_of(own, delay, hand), wanders);
      rig.loop.arm();
      for (int i = 0; i < 8000; ++i) {
        rig.run(1);
        max_speed = std::max(max_speed, glm::length(rig.device.lever.true_velocity()));
      }
    }
    return max_speed;
  };
  for (const HandImpedance& hand : {kLightHand, kGripHand}) {
    const double without = fastest(0.0, 0, hand);
    for (const int delay : {0, 3, 6}) {
      for (const double own : {1000.0, 3000.0}) {
        CAPTURE(delay);
        CAPTURE(own);
        CHECK(fastest(own, delay, hand) < 1.2 * without);  // at most 1.16 with eight seeds
      }
    }
  }
}

TEST_CASE("saturation is reported when loop and device together want more than the motors can give, and not before") {
  for (const double push : {20.0, 40.0}) {
    CAPTURE(push);
    PushingHand hand([push](double time, dvec2) { return dvec2{0.0, std::min(push, push * time)}; });
    Rig rig(lever_of(3000.0, 3), hand, plain_aisle(0.06, 0.01));
    rig.loop.arm();
    bool saturated = false;
    for (int i = 0; i < 2500; ++i) {
      rig.run(1);
      saturated = saturated || (rig.out().flags & kFlagSaturated) != 0;
    }
    CHECK(saturated == (push > 31.7));
  }
}
