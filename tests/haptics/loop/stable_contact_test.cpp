// The loop's own defences of a contact: what it softens, bounds, tells, and replays.
#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/replay.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/haptics/loop/trace_bench.h"
#include "tests/support/gates.h"
#include "tests/support/hands.h"

using namespace gearshift;
using glm::dvec2;

namespace {

// A bare handle pushed into the upper wall of the neutral aisle, between two columns.
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
  const double end = run.time() + seconds;
  while (run.time() < end) {
    run.step();
    for (HapticEvent event; run.channels().events.pop(event);) events.push_back(event);
  }
  return events;
}

std::ptrdiff_t count(const std::vector<HapticEvent>& events, EventKind kind) {
  return std::count_if(events.begin(), events.end(), [kind](const HapticEvent& e) { return e.kind == kind; });
}

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

TEST_CASE("a wall forced on a device that does not bear it is softened until it is still, and says so") {
  PushingHand hand = push_of(15.0);
  SimulatedRunConfig config = pushed(paper_gate(), 100.0, 0);
  config.haptics.contact = {ContactHold::half_sample, EnergyControl::none, true, true};
  SimulatedRun run(config, hand);
  const std::vector<HapticEvent> events = run_events(run, 5.0);
  CHECK(count(events, EventKind::stiffness_lowered) >= 3);
  CHECK(run.loop().snapshot().wall_stiffness < 1500.0);
  CHECK(span_of(run, 0.5) < 0.0003);
  run.channels().commands.push(LoopCommand::disarm);
  run.step();
  run.channels().commands.push(LoopCommand::arm);
  run.step();
  CHECK(run.loop().snapshot().wall_stiffness == 5000.0);  // a new start: nothing learnt is kept

  config.haptics.contact.reversal_limiter = false;  // negative control
  PushingHand same = push_of(15.0);
  SimulatedRun without(config, same);
  CHECK(count(run_events(without, 5.0), EventKind::stiffness_lowered) == 0);
  CHECK(span_of(without, 0.5) > 0.01);
}

TEST_CASE("what chatters on at the floor is bounded by its energy: a device that lies about its mass") {
  class Liar final : public HapticDevice {
   public:
    explicit Liar(SimulatedLever& lever) : lever_(lever), spec_(lever.spec()) {
      spec_.axis_x.mass = spec_.axis_y.mass = 4.0;
    }
    const DeviceSpec& spec() const noexcept override { return spec_; }
    LeverReading read(std::int64_t now_ns) noexcept override { return lever_.read(now_ns); }
    void write(dvec2 force) noexcept override { lever_.write(force); }
    void release() noexcept override { lever_.release(); }

   private:
    SimulatedLever& lever_;
    DeviceSpec spec_;
  };
  const Gate gate = paper_gate();
  PushingHand hand = push_of(15.0);
  const SimulatedRunConfig rig = pushed(gate, 100.0, 0);
  SimulatedLever lever(rig.lever, 10'000'000, hand);
  lever.place(rig.start);
  Liar liar(lever);
  NullWorld world;
  LoopChannels channels;
  HapticConfig config = rig.haptics;
  HapticLoop loop(config, gate, liar, world, channels);  // 4 kg bear 5000 N/m at 100 Hz; 0.09 kg do not
  CHECK(loop.admitted().tuning.wall_stiffness == 5000.0);
  loop.arm();
  std::int64_t now = 0;
  int bounded = 0;
  for (int n = 0; n < 3000; ++n) {
    loop.cycle(now += 10'000'000, 0);
    for (HapticEvent event; channels.events.pop(event);) bounded += event.kind == EventKind::energy_bounded;
  }
  CHECK(bounded == 1);
  double low = 1.0, high = -1.0;
  for (int n = 0; n < 50; ++n) {
    loop.cycle(now += 10'000'000, 0);
    low = std::min(low, lever.true_position().y);
    high = std::max(high, lever.true_position().y);
  }
  CHECK(high - low < 0.001);  // it was 100 times that
}

TEST_CASE("a change while running passes the same check as at the start, and what is admitted is used") {
  RestingHand nobody;
  SimulatedRun run(pushed(paper_gate(), 200.0, 0), nobody);
  HapticTuning wanted;
  wanted.wall_stiffness = 20000.0;
  wanted.wall_damping = 100.0;
  const AdmittedTuning admitted = run.loop().change_tuning(wanted);
  CHECK(admitted.limited.size() >= 2);
  CHECK(admitted.tuning.wall_stiffness < 1300.0);
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
    TraceRecorder recorder(folder / "contact.trace", header, run.channels(), TracePump::by_caller);
    for (int n = 0; n < 3000; ++n) {
      run.step();
      if (n % 500 == 0) recorder.pump();
    }
    CHECK(recorder.finish().problem.empty());
    const ReplayResult result = replay(read_trace(folder / "contact.trace"));
    CHECK(result.bit_for_bit());
    CHECK(result.cycles == 3000);
  }
}
