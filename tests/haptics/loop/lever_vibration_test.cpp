// The loop must distinguish a load that vibrates the lever from a load that makes the lever chatter. It softens walls
// only for chatter.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "haptics/device/pushing_hand.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// A load with a sinusoidal force along the shift axis, declared as vibration if `declares_vibration`.
class VibratingLoad final : public LeverLoad {
 public:
  VibratingLoad(double frequency, double amplitude, bool declares_vibration)
      : frequency_(frequency), amplitude_(amplitude), declares_vibration_(declares_vibration) {}
  LeverOutput step(const LeverInput&, double period) noexcept override {
    time_ += period;
    LeverOutput out;
    out.force.y = amplitude_ * std::sin(2.0 * std::numbers::pi * frequency_ * time_);
    if (declares_vibration_) out.vibration = out.force;
    return out;
  }
  const char* replay_parameters() const noexcept override { return "shaking"; }

 private:
  double frequency_, amplitude_;  // [Hz], [N]
  bool declares_vibration_;
  double time_ = 0.0;
};

// A load with a constant friction force against the motion, a textbook cause of chatter.
class RoughLoad final : public LeverLoad {
 public:
  LeverOutput step(const LeverInput& in, double) noexcept override {
    LeverOutput out;
    out.force.y = in.velocity.y == 0.0 ? 0.0 : -std::copysign(15.0, in.velocity.y);
    return out;
  }
  const char* replay_parameters() const noexcept override { return "rough"; }
};

struct VibrationResult {
  int lowered = 0;
  double moved = 0.0;  // [m] range of the lever's motion in the last half second
};

// Runs a lever in `gear`, held by a hand `grip` that pushes with `push` [N]: x sideways, y along the shift axis.
VibrationResult run_vibrated(LeverLoad& load, const HandImpedance& grip, int gear, dvec2 push, double seconds = 4.0,
                             double rate = 1000.0) {
  SimulatedRunConfig config;
  config.gate = paper_gate();
  config.start = rest_position(config.gate, gear);
  config.haptics.rate = rate;
  config.haptics.guard.ramp_time = 0.01;
  config.lever.hand = grip;
  PushingHand hand([push](double time, dvec2) { return std::min(1.0, 2.0 * time) * push; });
  SimulatedRun run(config, hand, &load);
  VibrationResult out;
  EventLog events;
  double low = 1.0, high = -1.0;
  while (run.time() < seconds) {
    const double y = run.step().lever.y;
    events.see(run.loop());
    if (run.time() < seconds - 0.5) continue;
    low = std::min(low, y);
    high = std::max(high, y);
  }
  out.moved = high - low;
  out.lowered = events.count(EventKind::stiffness_lowered);
  return out;
}

}  // namespace

TEST_CASE("a lever that its load vibrates keeps its walls, in a gear, at its walls and out of it, in every hand") {
  int mistaken = 0, counted = 0;
  double widest = 0.0;
  for (const NamedHand& named : kNamedHands) {
    for (const int gear : {kNeutralGear, 1, 2, kReverseGear}) {
      for (const dvec2 push : {dvec2{0.0, 0.0}, {6.0, 0.0}, {0.0, 6.0}, {6.0, -6.0}}) {
        for (const double frequency : {8.0, 12.0, 16.0, 20.0, 24.0}) {
          for (const double amplitude : {0.3, 1.0, 2.1}) {
            if (counted++ % 7 != 0 && !is_full_campaign()) continue;
            CAPTURE(named.name);
            CAPTURE(gear);
            CAPTURE(push.x);
            CAPTURE(push.y);
            CAPTURE(frequency);
            CAPTURE(amplitude);
            VibratingLoad declared(frequency, amplitude, true), undeclared(frequency, amplitude, false);
            const VibrationResult lever = run_vibrated(declared, named.hand, gear, push);
            CHECK(lever.lowered == 0);
            widest = std::max(widest, lever.moved);
            mistaken += run_vibrated(undeclared, named.hand, gear, push).lowered > 0 ? 1 : 0;  // negative control
          }
        }
      }
    }
  }
  CHECK(widest > 0.001);
  CHECK(mistaken > (is_full_campaign() ? 300 : 40));
}

TEST_CASE("a lever that its load vibrates keeps its walls at 4 kHz and at 500 Hz, too") {
  for (const double rate : {500.0, 4000.0}) {
    for (const double frequency : {12.0, 20.0}) {
      VibratingLoad load(frequency, 1.0, true);
      CHECK(run_vibrated(load, kGripHand, 1, {6.0, 0.0}, 4.0, rate).lowered == 0);
    }
  }
}

TEST_CASE("a load force that reacts to the lever does not count as vibration: friction as sign(v) is still detected") {
  RoughLoad load;
  CHECK(run_vibrated(load, kGripHand, 1, {6.0, 6.0}).lowered > 0);
}

namespace {

// Presses a lever into a wall. The lever has more delay than its spec states. Returns how often the loop softens the
// wall.
int lowered_of_a_late_lever(LeverLoad& load) {
  const Gate gate = paper_gate();
  PushingHand hand([](double time, dvec2) { return dvec2{0.0, 9.0 * std::min(1.0, time)}; });
  SimulatedLeverConfig late;
  late.delay = 6;
  SimulatedLever lever(late, 1'000'000, hand);
  class FaultyLever final : public HapticDevice {
   public:
    explicit FaultyLever(SimulatedLever& behind) : lever_(behind), spec_(behind.spec()) { spec_.delay = 0; }
    const DeviceSpec& spec() const noexcept override { return spec_; }
    LeverReading read(std::int64_t now_ns) noexcept override { return lever_.read(now_ns); }
    void write(dvec2 force) noexcept override { lever_.write(force); }
    void release() noexcept override { lever_.release(); }

   private:
    SimulatedLever& lever_;
    DeviceSpec spec_;
  } faulty(lever);
  LoopInputs inputs;
  HapticConfig config;
  HapticLoop loop(config, gate, faulty, load, inputs);
  lever.place({0.5 * (gate.column[0].center + gate.column[1].center), 0.0});
  loop.arm();
  EventLog events;
  for (int n = 1; n <= 4000; ++n) {
    loop.cycle(1'000'000 * static_cast<std::int64_t>(n), 0);
    events.see(loop);
  }
  return events.count(EventKind::stiffness_lowered);
}

}  // namespace

TEST_CASE("a wall that is too stiff for its device is softened as much while the load vibrates the lever") {
  VibratingLoad still(20.0, 0.0, true), shaking(20.0, 1.5, true);
  const int calm = lowered_of_a_late_lever(still);
  CHECK(calm > 0);
  CHECK(lowered_of_a_late_lever(shaking) >= calm);
}
