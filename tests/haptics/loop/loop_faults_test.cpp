// Tests of the complete cycle with a failing device: the force stays finite and small, and decays within the guaranteed
// time.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lab/bench/lever/pressed_rig.h"
#include "haptics/device/pushing_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/joystick/finite.h"
#include "haptics/loop/haptic_loop.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// A loop on a simulated lever without a hand. On a simulated device, the loop arms itself again after a fault.
struct IdleRig {
  IdleRig() : lever({}, kPeriodNs, idle_hand), loop(HapticConfig{}, paper_gate(), lever, load, inputs) { loop.arm(); }
  void run(int cycles, std::int64_t skipped) {
    for (int i = 0; i < cycles; ++i) {
      loop.cycle(now += kPeriodNs * (1 + skipped), skipped);
      events.see(loop);
    }
  }

  IdleHand idle_hand;
  SimulatedLever lever;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop;
  EventLog events;
  std::int64_t now = 0;
};

}  // namespace

TEST_CASE("the rig itself: the wall's force equals the push within 3 %") {
  PressedRig rig(paper_gate());
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  double mean = 0.0;
  for (int i = 0; i < 50; ++i) {
    rig.run(1);
    mean -= rig.lever.written.y / 50.0;
  }
  // The wall's force is the push of 15 N minus the handle's spring force, 15.7 N/m at about 9 mm.
  CHECK(mean == doctest::Approx(15.0 - kPaperAxisY.stiffness * rig.loop.snapshot().lever.y).epsilon(0.03));
}

TEST_CASE("fault to zero force: frozen, not finite, jumping, lost and backward readings") {
  for (const Fault& fault : reading_faults()) {
    CAPTURE(fault.name);
    PressedRig rig(paper_gate());
    rig.lever.sabotage = fault.sabotage();
    CHECK(rig.cycles_to_zero() <= fault.within);
    rig.run(500);
    CHECK(rig.finite);
    CHECK(rig.strongest <= 31.7 * std::sqrt(2.0));
    CHECK(rig.lever.written == dvec2{0.0, 0.0});
    CHECK(in_free_space(rig.gate, rig.loop.snapshot().proxy, 1e-9));
    // On a real device, valid readings do not restore the force until the loop is armed again.
    rig.lever.sabotage = nullptr;
    rig.run(1000);
    CHECK(rig.loop.snapshot().guard != GuardState::running);
    rig.inputs.commands.push(LoopCommand::arm);
    rig.run(1000);
    CHECK(rig.loop.snapshot().guard == GuardState::running);
  }
}

TEST_CASE("single lost, repeated and implausible readings are tolerated: still running, no kick") {
  PressedRig rig(paper_gate());
  std::mt19937_64 random(3);
  LeverReading last;
  rig.lever.sabotage = [&](LeverReading& r) {
    switch (random() % 20) {
      case 0:
        r = last;
        break;  // repeated
      case 1:
        r.position = {kNan, kInf};
        break;
      case 2:
        r.position.x += 0.03;
        break;  // the position jumps by 30 mm for one sample
      case 3:
        r.time_ns -= 5 * kPeriodNs;
        break;
      default:
        last = r;
        break;
    }
  };
  rig.strongest = 0.0;
  rig.run(5000);
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  CHECK(rig.finite);
  CHECK(rig.strongest < 25.0);  // [N] 15 N of steady force, plus the effect of repeated readings
}

TEST_CASE("late cycles: single ones are tolerated, eight in a row lead to damped") {
  PressedRig rig(paper_gate());
  for (int i = 0; i < 200; ++i) {
    rig.run(1, 2);
    rig.run(4);
  }
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  rig.run(8, 1);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
  CHECK(rig.loop.snapshot().fault == GuardFault::overruns);
  CHECK(rig.finite);
}

TEST_CASE("a simulated lever reports its fault and re-arms itself after 50 ms of fresh readings") {
  IdleRig rig;
  rig.run(1000, 0);
  rig.run(8, 1);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
  CHECK(rig.loop.snapshot().fault == GuardFault::overruns);
  rig.run(45, 0);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
  rig.run(15, 0);
  CHECK(rig.loop.snapshot().guard == GuardState::ramping);
}

TEST_CASE("a loop that is always late stays damped instead of switching the force on and off") {
  IdleRig rig;
  rig.run(2000, 1);
  CHECK(rig.events.count(EventKind::guard_changed) <= 3);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
}

TEST_CASE("a device that reports nonsense forces does not poison the snapshot") {
  PressedRig rig(paper_gate());
  rig.lever.sabotage = [](LeverReading& r) {
    r.hand_force = {kNan, kInf};
    r.actuator_force = {kInf, kNan};
  };
  rig.run(100);
  const HapticSnapshot& s = rig.loop.snapshot();
  CHECK(std::isfinite(s.f_h.x + s.f_h.y + s.f_a.x + s.f_a.y + s.f_j.x + s.f_j.y));
  CHECK(s.guard == GuardState::running);
}

TEST_CASE("the loop itself refuses an invalid config, even if the caller has not checked it") {
  const Gate gate = paper_gate();
  IdleHand idle_hand;
  SimulatedLever lever({}, kPeriodNs, idle_hand);
  NoLoad load;
  LoopInputs inputs;
  HapticConfig config;
  config.estimator.smoothing = 0.0;
  CHECK_THROWS_AS(HapticLoop(config, gate, lever, load, inputs), std::invalid_argument);
}

TEST_CASE("a cycle whose deadline runs backward is a stale reading, not a crash") {
  PressedRig rig(paper_gate());
  for (int i = 0; i < 5; ++i) rig.loop.cycle(rig.now - 50 * kPeriodNs, 0);
  rig.run(100);
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  CHECK(rig.finite);
}

TEST_CASE("stop: motors off in the same cycle, and released until a person arms it") {
  PressedRig rig(paper_gate());
  rig.inputs.commands.push(LoopCommand::stop);
  rig.run(1);
  CHECK(rig.lever.written == dvec2{0.0, 0.0});
  CHECK(rig.lever.releases >= 1);
  CHECK(rig.loop.snapshot().guard == GuardState::released);
}

TEST_CASE("the device's panic button: motors off in the same cycle, whatever else the reading says") {
  using Spoil = void (*)(LeverReading&);
  const Spoil spoils[] = {[](LeverReading&) {}, [](LeverReading& r) { r.sequence = 3; },
                          [](LeverReading& r) { r.position.x = kNan; }, [](LeverReading& r) { r.time_ns = 0; }};
  for (const Spoil spoil : spoils) {
    PressedRig rig(paper_gate());
    REQUIRE(glm::length(rig.lever.written) > 10.0);
    rig.lever.sabotage = [spoil](LeverReading& r) {
      r.stop = true;
      spoil(r);
    };
    CHECK(rig.cycles_to_zero() == 1);
    CHECK(rig.lever.releases == 1);
    CHECK(rig.loop.snapshot().guard == GuardState::released);
    CHECK(rig.loop.snapshot().fault == GuardFault::stopped);
  }
}

TEST_CASE("while the panic button is held nothing arms the loop; after release only a person does") {
  PressedRig rig(paper_gate());
  rig.lever.sabotage = [](LeverReading& r) { r.stop = true; };
  rig.run(1);
  for (int i = 0; i < 100; ++i) {
    rig.inputs.commands.push(LoopCommand::arm);
    rig.run(1);
    REQUIRE(rig.loop.snapshot().guard == GuardState::released);
    REQUIRE(rig.lever.written == dvec2{0.0, 0.0});
  }
  rig.lever.sabotage = nullptr;
  rig.run(1000);
  CHECK(rig.loop.snapshot().guard == GuardState::released);
  rig.inputs.commands.push(LoopCommand::arm);
  rig.run(1000);
  CHECK(rig.loop.snapshot().guard == GuardState::running);
}

TEST_CASE("armed and stopped in one cycle means stopped; a button held from the start keeps the loop idle") {
  PressedRig rig(paper_gate());
  rig.inputs.commands.push(LoopCommand::disarm);
  rig.run(1);
  rig.inputs.commands.push(LoopCommand::arm);
  rig.lever.sabotage = [](LeverReading& r) { r.stop = true; };
  rig.run(1);
  CHECK(rig.loop.snapshot().guard == GuardState::released);

  // A loop on a simulated lever arms itself again after other faults, but not after the stop button.
  class Pressed final : public HapticDevice {
   public:
    const DeviceSpec& spec() const noexcept override { return lever_.spec(); }
    LeverReading read(std::int64_t now_ns) noexcept override {
      LeverReading reading = lever_.read(now_ns);
      reading.stop = held;
      return reading;
    }
    void write(dvec2 force) noexcept override { lever_.write(force); }
    void release() noexcept override { lever_.release(); }
    bool held = true;

   private:
    IdleHand idle_hand_;
    SimulatedLever lever_{{}, kPeriodNs, idle_hand_};
  };
  Pressed lever;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop(HapticConfig{}, rig.gate, lever, load, inputs);
  std::int64_t now = 0;
  const auto run = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) loop.cycle(now += kPeriodNs, 0);
  };
  run(10);
  inputs.commands.push(LoopCommand::arm);
  run(10);
  CHECK(loop.snapshot().guard == GuardState::idle);
  lever.held = false;
  run(10);
  inputs.commands.push(LoopCommand::arm);
  run(600);
  CHECK(loop.snapshot().guard == GuardState::running);
  lever.held = true;
  run(1);
  lever.held = false;
  run(1000);
  CHECK(loop.snapshot().guard == GuardState::released);
}

TEST_CASE("a stop while the lever is damped removes the remaining force, also the one that is fading") {
  PressedRig rig(paper_gate());
  rig.run(8, 1);
  REQUIRE(rig.loop.snapshot().guard == GuardState::damped);
  rig.inputs.commands.push(LoopCommand::stop);
  rig.run(1);
  CHECK(rig.lever.written == dvec2{0.0, 0.0});
  CHECK(rig.loop.snapshot().guard == GuardState::released);
  CHECK(rig.loop.snapshot().fault == GuardFault::stopped);
}

TEST_CASE("a lever beyond the device's workspace plus margin: motors off in the cycle that accepts the reading") {
  PressedRig rig(paper_gate());
  const double limit = rig.lever.spec().workspace.y + GuardConfig{}.position_margin;
  rig.lever.sabotage = [y = rig.loop.snapshot().lever.y](LeverReading& r) mutable {
    r.position.y = y += 0.004;  // 4 m/s: plausible
  };
  for (int i = 0; i < 100 && rig.loop.snapshot().lever.y <= limit; ++i) {
    CHECK(rig.loop.snapshot().guard == GuardState::running);
    rig.run(1);
  }
  CHECK(rig.loop.snapshot().lever.y > limit);
  CHECK(rig.lever.written == dvec2{0.0, 0.0});
  CHECK(rig.lever.releases == 1);
  CHECK(rig.loop.snapshot().guard == GuardState::released);
  CHECK(rig.loop.snapshot().fault == GuardFault::limit_broken);
}

TEST_CASE("arming places the proxy at the lever: no pull towards its old position") {
  PressedRig rig(paper_gate());
  rig.inputs.commands.push(LoopCommand::disarm);
  rig.run(1);
  CHECK(rig.lever.releases >= 1);
  // While the loop is disarmed, the lever is placed in the slot of first gear, more than 20 mm from its old proxy.
  rig.lever.sabotage = [](LeverReading& r) { r.position = {-0.030, 0.030}; };
  rig.run(200);
  rig.inputs.commands.push(LoopCommand::arm);
  rig.run(1000);
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  CHECK(glm::length(rig.loop.snapshot().wall_force) == 0.0);
  CHECK(slot_at(rig.gate, rig.loop.snapshot().proxy) == slot_of_gear(rig.gate, 1));
}

// A lever held at a given position, whatever the motors do.
class PlacedLever final : public HapticDevice {
 public:
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override {
    LeverReading reading;
    reading.sequence = static_cast<std::uint64_t>(now_ns / kPeriodNs) + 1;
    reading.time_ns = now_ns;
    reading.position = place;
    return reading;
  }
  void write(dvec2) noexcept override {}
  void release() noexcept override {}

  dvec2 place{0.0};

 private:
  DeviceSpec spec_{.workspace = kPaperWorkspace};
};

TEST_CASE(
    "arming while forces are on changes nothing: the proxy stays before the lockout that the lever presses into") {
  const Gate gate =
      compile_gate(read_gate_layout(GEARSHIFT_ASSETS "/gates/five_speed_r_left_up.toml"), kPaperWorkspace);
  PlacedLever lever;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop(HapticConfig{}, gate, lever, load, inputs);
  loop.arm();
  std::int64_t now = 0;
  for (int i = 0; i < 1000; ++i) loop.cycle(now += kPeriodNs, 0);
  REQUIRE(loop.snapshot().guard == GuardState::running);
  const double reverse = rest_position(gate, kReverseGear).x;
  while (lever.place.x > reverse) {  // 20 mm/s
    lever.place.x -= 2e-5;
    loop.cycle(now += kPeriodNs, 0);
  }
  const double held = loop.snapshot().proxy.x;
  REQUIRE(held > reverse + 0.003);  // the lockout's wall is between proxy and reverse
  const double force = loop.snapshot().wall_force.x;
  REQUIRE(force > 5.0);
  for (int i = 0; i < 100; ++i) {
    inputs.commands.push(LoopCommand::arm);
    loop.cycle(now += kPeriodNs, 0);
  }
  CHECK(loop.snapshot().guard == GuardState::running);
  CHECK(loop.snapshot().proxy.x == doctest::Approx(held));
  CHECK(loop.snapshot().wall_force.x == doctest::Approx(force).epsilon(0.01));
}

TEST_CASE("with d samples of delay the coupling looks (1 + 2 d) half periods ahead") {
  for (const int delay : {0, 1, 3}) {
    CAPTURE(delay);
    // A lever that moves into the upper wall of the neutral aisle at constant speed.
    class Mover final : public HapticDevice {
     public:
      explicit Mover(int delay) {
        spec_.delay = delay;
        spec_.workspace = kPaperWorkspace;
      }
      const DeviceSpec& spec() const noexcept override { return spec_; }
      LeverReading read(std::int64_t now_ns) noexcept override {
        LeverReading reading;
        reading.sequence = static_cast<std::uint64_t>(now_ns / kPeriodNs) + 1;
        reading.time_ns = now_ns;
        reading.position = {-0.015, 1e-9 * 0.02 * static_cast<double>(now_ns)};
        return reading;
      }
      void write(dvec2) noexcept override {}
      void release() noexcept override {}

     private:
      DeviceSpec spec_;
    };
    Mover mover(delay);
    const Gate gate = paper_gate();
    NoLoad load;
    LoopInputs inputs;
    HapticConfig config;
    config.tuning.wall_stiffness = 1000.0;  // [N/m] low enough to be admitted with each delay
    config.tuning.wall_damping = 2.0;
    HapticLoop loop(config, gate, mover, load, inputs);
    for (int i = 0; i < 400; ++i) loop.cycle(i * kPeriodNs, 0);
    const double depth = loop.snapshot().lever.y - gate.half_aisle;
    REQUIRE(depth > 0.001);
    const double expected = 1000.0 * (depth + 0.02 * 0.001 * (1.0 + 2.0 * delay) / 2.0) + 2.0 * 0.02;
    CHECK(-loop.snapshot().wall_force.y == doctest::Approx(expected));
  }
}

TEST_CASE("a load that returns invalid values releases the motors") {
  class InvalidLoad final : public LeverLoad {
   public:
    LeverOutput step(const LeverInput&, double) noexcept override {
      LeverOutput out;
      if (++steps_ > 700) out.force = {kNan, 1e300};
      return out;
    }
    const char* replay_parameters() const noexcept override { return "mad"; }

   private:
    int steps_ = 0;
  };
  for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
    CAPTURE(static_cast<int>(hold));
    PressedRig rig(paper_gate());
    InvalidLoad load;
    HapticConfig config;
    config.contact.hold = hold;
    HapticLoop loop(config, rig.gate, rig.lever, load, rig.inputs);
    loop.arm();
    for (int i = 0; i < 710; ++i) loop.cycle(rig.now += kPeriodNs, 0);
    CHECK(loop.snapshot().guard == GuardState::released);
    CHECK(loop.snapshot().fault == GuardFault::not_finite);
    CHECK(rig.lever.written == dvec2{0.0, 0.0});
    // With the observer hold, the wall force contains the load's force, which is invalid here.
    CHECK(is_finite(loop.snapshot().wall_force));
  }
}
