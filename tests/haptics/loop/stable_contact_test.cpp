// Tests how the loop keeps contacts stable: softening, energy bounding, reports and replay.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/device/pushing_hand.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/haptics/loop/trace_bench.h"
#include "tests/support/event_log.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// A gate with one wall ahead and one behind, without feel forces that guide the lever.
Gate walled_gate() {
  return plain_aisle(0.060, 0.006);
}

// A run with a bare handle that starts in the middle of the neutral aisle, between two columns.
SimulatedRunConfig pushed(const Gate& gate, double rate, int delay) {
  SimulatedRunConfig config;
  config.haptics.rate = rate;
  config.haptics.guard.ramp_time = 0.01;
  config.lever.delay = delay;
  config.gate = gate;
  config.start = {0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
  return config;
}

PushingHand push_of(double newton) {
  return PushingHand([newton](double time, dvec2) { return dvec2{0.0, newton * std::min(1.0, 10.0 * time)}; });
}

std::vector<HapticEvent> run_events(SimulatedRun& run, double seconds) {
  std::vector<HapticEvent> events;
  EventDetector detector;
  const double end = run.time() + seconds;
  while (run.time() < end) {
    run.step();
    detector.update(run.loop().published(), events);
  }
  return events;
}

std::ptrdiff_t count(const std::vector<HapticEvent>& events, EventKind kind) {
  return std::count_if(events.begin(), events.end(), [kind](const HapticEvent& e) { return e.kind == kind; });
}

// Pulls the lever along the shift axis with a constant force.
class PullingLoad final : public LeverLoad {
 public:
  explicit PullingLoad(double newton) : newton_(newton) {}
  LeverOutput step(const LeverInput&, double) noexcept override {
    LeverOutput out;
    out.force = {0.0, newton_};
    return out;
  }
  const char* replay_parameters() const noexcept override { return "pulling"; }

 private:
  double newton_;
};

double span_of(SimulatedRun& run, double seconds) {
  double low = 1.0, high = -1.0;
  const double end = run.time() + seconds;
  while (run.time() < end) {
    run.step();
    low = std::min(low, run.lever().true_position().y);
    high = std::max(high, run.lever().true_position().y);
  }
  return high - low;
}

}  // namespace

TEST_CASE("a wall that is unstable on its device is softened until it is at rest, and this is reported") {
  PushingHand hand = push_of(15.0);
  SimulatedRunConfig config = pushed(walled_gate(), 100.0, 0);
  config.haptics.contact = {ContactHold::half_sample, EnergyControl::none, true, true};
  SimulatedRun run(config, hand);
  const std::vector<HapticEvent> events = run_events(run, 5.0);
  CHECK(count(events, EventKind::stiffness_lowered) >= 3);
  CHECK(run.loop().snapshot().wall_stiffness < 1500.0);
  CHECK(span_of(run, 0.5) < 0.0003);
  run.inputs().commands.push(LoopCommand::disarm);
  run.step();
  run.inputs().commands.push(LoopCommand::arm);
  run.step();
  CHECK(run.loop().snapshot().wall_stiffness == 5000.0);  // arming resets the limiter to the full stiffness

  config.haptics.contact.reversal_limiter = false;  // negative control
  PushingHand same = push_of(15.0);
  SimulatedRun without(config, same);
  CHECK(count(run_events(without, 5.0), EventKind::stiffness_lowered) == 0);
  CHECK(span_of(without, 0.5) > 0.01);
}

namespace {

// A simulated lever whose commands take effect later than its spec says, or whose readings jitter.
class FaultyLever final : public HapticDevice {
 public:
  FaultyLever(SimulatedLever& lever, int claimed_delay) : lever_(lever), spec_(lever.spec()) {
    spec_.delay = claimed_delay;
  }
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override {
    LeverReading reading = lever_.read(now_ns);
    if (jitters) reading.position.y += 0.001 * std::sin(2.0 * 3.14159265 * 30.0 * 1e-9 * static_cast<double>(now_ns));
    return reading;
  }
  void write(dvec2 force) noexcept override {
    written = force;
    lever_.write(force);
  }
  void release() noexcept override { lever_.release(); }

  bool jitters = false;
  dvec2 written{0.0};

 private:
  SimulatedLever& lever_;
  DeviceSpec spec_;
};

struct FaultyRig {
  FaultyRig(const Gate& gate, int real_delay, int claimed_delay, const HandImpedance& grip, bool limiter)
      : hand([](double time, dvec2) {
          // The motors can sustain 9 N indefinitely.
          return dvec2{0.0, 9.0 * std::min(1.0, time)};
        }),
        lever(lever_config(real_delay, grip), 1'000'000, hand),
        faulty(lever, claimed_delay),
        loop(config(limiter), gate, faulty, load, inputs) {
    lever.place({0.5 * (gate.column[0].center + gate.column[1].center), 0.0});
    loop.arm();
  }
  static SimulatedLeverConfig lever_config(int delay, const HandImpedance& grip) {
    SimulatedLeverConfig config;
    config.delay = delay;
    config.hand = grip;
    return config;
  }
  static HapticConfig config(bool limiter) {
    HapticConfig config;
    config.contact.allow_unstable = !limiter;
    config.contact.reversal_limiter = limiter;
    return config;
  }
  // Returns the minimum and maximum true depth of the lever beyond `wall` during `seconds` [m].
  std::pair<double, double> run(double seconds, double wall) {
    double low = 1.0, high = -1.0;
    for (int n = 0; n < static_cast<int>(1000.0 * seconds); ++n) {
      loop.cycle(now += 1'000'000, 0);
      low = std::min(low, lever.true_position().y - wall);
      high = std::max(high, lever.true_position().y - wall);
      events.see(loop);
    }
    lowered = events.count(EventKind::stiffness_lowered);
    return {low, high};
  }

  PushingHand hand;
  SimulatedLever lever;
  FaultyLever faulty;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop;
  std::int64_t now = 0;
  EventLog events;
  int lowered = 0;
};

}  // namespace

TEST_CASE("a device with more delay than specified: softened until the lever rests in the wall, not on the stop") {
  const Gate gate = walled_gate();
  const struct {
    int real, claimed;
    HandImpedance hand;
  } lies[] = {{5, 0, kBareHand}, {8, 0, kBareHand}, {8, 0, kGripHand}, {4, 1, kBareHand}};
  for (const auto& lie : lies) {
    CAPTURE(lie.real);
    CAPTURE(lie.claimed);
    FaultyRig rig(gate, lie.real, lie.claimed, lie.hand, true);
    rig.run(12.0, gate.half_aisle);
    const auto [low, high] = rig.run(1.0, gate.half_aisle);
    CHECK(rig.loop.snapshot().guard == GuardState::running);
    CHECK(rig.lowered >= 1);
    CHECK(high - low < 0.0005);
    CHECK(low > 0.0);
    CHECK(high < 0.060);  // not on the lever's stop, 63 mm behind the wall
    CHECK(-rig.loop.snapshot().f_a.y == doctest::Approx(-9.0).epsilon(0.2));

    FaultyRig control(gate, lie.real, lie.claimed, lie.hand, false);
    control.run(4.0, gate.half_aisle);
    const auto [lowest, highest] = control.run(1.0, gate.half_aisle);
    CHECK(highest - lowest > 0.0005);
  }
}

TEST_CASE("a lever that vibrates regardless of the wall is damped with a reason, and does not re-arm itself") {
  const Gate gate = walled_gate();
  FaultyRig rig(gate, 0, 0, kBareHand, true);
  rig.run(2.0, gate.half_aisle);
  REQUIRE(rig.loop.snapshot().guard == GuardState::running);
  rig.faulty.jitters = true;
  rig.run(6.0, gate.half_aisle);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
  CHECK(rig.loop.snapshot().fault == GuardFault::chatter);
  rig.faulty.jitters = false;
  rig.run(3.0, gate.half_aisle);
  CHECK(rig.loop.snapshot().guard == GuardState::damped);
  rig.inputs.commands.push(LoopCommand::arm);
  rig.run(3.0, gate.half_aisle);
  CHECK(rig.loop.snapshot().guard == GuardState::running);
  CHECK(rig.loop.snapshot().wall_stiffness == 5000.0);
}

TEST_CASE("moving another slider does not give a chattering wall its stiffness back") {
  const Gate gate = walled_gate();
  FaultyRig rig(gate, 5, 0, kBareHand, true);
  HapticTuning tuning = rig.loop.admitted().tuning;
  for (int i = 0; i < 700; ++i) {  // every 16 ms
    tuning.feel_scale = i % 2 ? 0.9 : 1.0;
    rig.loop.change_tuning(tuning);
    rig.run(0.016, gate.half_aisle);
  }
  CHECK(rig.loop.snapshot().wall_stiffness < 5000.0);
  tuning.wall_stiffness = 4000.0;
  rig.loop.change_tuning(tuning);
  rig.run(0.001, gate.half_aisle);
  CHECK(rig.loop.snapshot().wall_stiffness == 4000.0);
}

TEST_CASE("a change while running passes the same check as at the start, and what is admitted is used") {
  IdleHand idle_hand;
  SimulatedRun run(pushed(walled_gate(), 200.0, 0), idle_hand);
  HapticTuning wanted;
  wanted.wall_stiffness = 20000.0;
  wanted.wall_damping = 100.0;
  const AdmittedTuning admitted = run.loop().change_tuning(wanted);
  CHECK(admitted.limits.size() >= 2);
  CHECK(admitted.tuning.wall_stiffness == doctest::Approx(0.58 * 0.086 / (0.005 * 0.005)));
  run.step();
  CHECK(run.loop().snapshot().wall_stiffness == admitted.tuning.wall_stiffness);
  wanted.wall_stiffness = -1.0;
  CHECK_THROWS_AS(run.loop().change_tuning(wanted), std::invalid_argument);
  run.step();
  CHECK(run.loop().snapshot().wall_stiffness == admitted.tuning.wall_stiffness);
}

TEST_CASE("every hold, energy control and the limiter replay bit for bit") {
  const struct {
    double rate;
    int delay;
    ContactConfig contact;
    int window;
  } cases[] = {{1000.0, 2, {}, 1},
               {100.0, 0, {ContactHold::half_sample, EnergyControl::none, true, true}, 1},
               {1000.0, 3, {ContactHold::observer, EnergyControl::energy_bounding, true, false}, 1},
               {1000.0, 0, {ContactHold::zero_order, EnergyControl::passivity_controller, true, true}, 15}};
  for (const auto& c : cases) {
    CAPTURE(c.rate);
    CAPTURE(c.delay);
    PushingHand hand = push_of(15.0);
    SimulatedRunConfig config = pushed(paper_gate(), c.rate, c.delay);
    config.haptics.contact = c.contact;
    config.haptics.estimator.window = c.window;
    SimulatedRun run(config, hand);
    TraceHeader header = paper_header();
    header.config = config.haptics;
    header.device = run.lever().spec();
    header.armed = true;
    const TempFolder folder;
    TraceRecorder recorder(folder / "contact.trace", header);
    for (int n = 0; n < 3000; ++n) {
      run.step();
      recorder.add(run.loop().published());
    }
    CHECK(recorder.finish().problem.empty());
    const ReplayResult result = replay(read_trace(folder / "contact.trace"));
    CHECK(result.bit_for_bit());
    CHECK(result.cycles == 3000);
  }
}

TEST_CASE("energy control that a configuration selects is active from the first cycle") {
  const auto depth = [](EnergyControl control) {
    PushingHand hand = push_of(9.0);
    SimulatedRunConfig config = pushed(walled_gate(), 1000.0, 0);
    config.haptics.contact.energy_control = control;
    SimulatedRun run(config, hand);
    run_events(run, 2.0);
    return run.loop().snapshot().lever.y - config.gate.half_aisle;
  };
  CHECK(depth(EnergyControl::none) < 0.0020);             // 9 N / 5000 N/m = 1.8 mm
  CHECK(depth(EnergyControl::energy_bounding) > 0.0028);  // 9 N / 2900 N/m = 3.1 mm; stiffness limit: damping / period
}

TEST_CASE("a change of tuning keeps the hold in use, and its values are checked") {
  IdleHand idle_hand;
  SimulatedRunConfig config = pushed(walled_gate(), 1000.0, 2);
  config.haptics.tuning.wall_stiffness = 2000.0;  // so low that the loop chooses the half-sample hold
  SimulatedRun run(config, idle_hand);
  REQUIRE(run.loop().admitted().hold == ContactHold::half_sample);
  // The default of 5000 N/m would need the observer hold, but the hold is chosen only at the start.
  const AdmittedTuning changed = run.loop().change_tuning({});
  CHECK(changed.hold == ContactHold::half_sample);
  CHECK(changed.tuning.wall_stiffness == doctest::Approx(0.25 * 0.086 / 9e-6));
  for (const double bad : {20001.0, std::nan("")}) {
    HapticTuning tuning;
    tuning.wall_stiffness = bad;
    CHECK_THROWS_AS(run.loop().change_tuning(tuning), std::invalid_argument);
  }
}

TEST_CASE("vibration in free space does not soften the walls") {
  IdleHand idle_hand;
  SimulatedLever lever({}, 1'000'000, idle_hand);
  FaultyLever faulty(lever, 0);
  faulty.jitters = true;  // the position jitters by 2 mm, in an aisle of 12 mm
  NoLoad load;
  LoopInputs inputs;
  const Gate gate = walled_gate();
  lever.place({0.5 * (gate.column[0].center + gate.column[1].center), 0.0});
  HapticLoop loop(HapticConfig{}, gate, faulty, load, inputs);
  loop.arm();
  for (int n = 1; n < 5000; ++n) loop.cycle(n * std::int64_t{1'000'000}, 0);
  CHECK(loop.snapshot().wall_stiffness == 5000.0);
  CHECK(loop.snapshot().guard == GuardState::running);
}

// Feel and load forces must not count as penetration of the wall. If the observer counted them, the wall force would
// jump by K T^2 / (4 m) + B T / (2 m) times these forces, after the delay (stiffness K and damping B of the wall, mass
// m, period T). This jump would excite a heavy hand at the end of a slot, where the lock's spring also acts.
TEST_CASE("at rest a wall makes K x, whatever feel and load forces act beside it") {
  const Gate aisle = walled_gate(), gate = paper_gate();
  for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
    for (const double pull : {-8.0, 0.0, 8.0}) {
      for (const bool in_gear : {false, true}) {
        CAPTURE(static_cast<int>(hold));
        CAPTURE(pull);
        CAPTURE(in_gear);
        SimulatedRunConfig config = pushed(in_gear ? gate : aisle, 1000.0, 2);
        if (in_gear) config.start = rest_position(gate, 1);
        config.haptics.contact.hold = hold;
        config.haptics.tuning.wall_stiffness = 2000.0;
        PushingHand hand = push_of(25.0);
        PullingLoad load(pull);
        SimulatedRun run(config, hand, &load);
        run_events(run, 2.0);
        double depth = 0.0, force = 0.0;  // [m], [N] means, because encoder counts make the force fluctuate
        for (int i = 0; i < 500; ++i) {
          const HapticSnapshot& now = run.step();
          depth += (now.lever.y - now.proxy.y) / 500.0;
          force -= now.wall_force.y / 500.0;
        }
        REQUIRE(depth > 1e-3);
        CHECK((std::abs(run.loop().snapshot().feel_force.y) > 1.0) == in_gear);
        CHECK(force == doctest::Approx(2000.0 * depth).epsilon(0.02));
      }
    }
  }
}

namespace {

class HeldHand final : public HandDriver {
 public:
  HandTarget next(double, dvec2) noexcept override {
    HandTarget target;
    target.push = {12.0, 0.0};
    return target;
  }
};

// Turning points of the lever about its rest 12 N deep in a wall, after a small kick. [m]
std::vector<double> turning_points(SimulatedRunConfig config) {
  HeldHand hand;
  SimulatedRun run(config, hand);
  while (run.time() < 3.0) run.step();
  const double rest = run.lever().true_position().x;
  run.lever().place({rest, 0.0}, {0.01, 0.0});
  std::vector<double> turns;
  double before = 0.0, last = 0.0;
  for (const double end = run.time() + 1.0; run.time() < end;) {
    run.step();
    const double x = run.lever().true_position().x - rest;
    if ((last - before) * (x - last) < 0.0) turns.push_back(std::abs(last));
    before = std::exchange(last, x);
  }
  return turns;
}

}  // namespace

TEST_CASE(
    "swing: at 1.1 times the stiffness that its law admits, an arm's swing shrinks to a third in seven half-swings") {
  for (const auto& [rate, delay] : {std::pair{1000.0, 1}, {2000.0, 2}, {4000.0, 8}, {500.0, 0}}) {
    CAPTURE(rate);
    CAPTURE(delay);
    SimulatedRunConfig config;
    config.haptics.rate = rate;
    config.haptics.tuning.wall_stiffness = 20000.0;
    config.lever.encoder_counts = 0.0;
    config.lever.axis_x = config.lever.axis_y = kPaperAxisY;
    config.lever.delay = delay;
    config.lever.hand = kArmHand;
    config.gate = plain_aisle(0.005, 0.030);
    IdleHand nobody;
    const AdmittedTuning admitted = SimulatedRun(config, nobody).loop().admitted();
    REQUIRE(admitted.hold == ContactHold::observer);
    const auto is_swing = [](const TuningLimit& one) { return one.law.find("swing above 10 Hz") != std::string::npos; };
    REQUIRE(std::any_of(admitted.limits.begin(), admitted.limits.end(), is_swing));
    config.haptics.tuning = admitted.tuning;
    config.haptics.tuning.wall_stiffness *= 1.1;
    config.haptics.contact = {ContactHold::observer, EnergyControl::none, false, true};
    const std::vector<double> turns = turning_points(config);
    REQUIRE(turns.size() > 8);
    CHECK(turns[8] / turns[1] <= 1.0 / 3.0);
    CHECK(turns[8] / turns[1] >= 0.9 / 3.0);  // the wall could not be much stiffer
  }
}
