// A real lever in the user's hand: the program does not move it, only the user arms it, and its recordings replay.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/rt/monotonic_clock.h"
#include "tests/app/runtime/runtime_rig.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// The emulated stick's state, commands and failures, which outlive the runtimes that use the stick.
struct Stick {
  ScriptedHand hand = tour_of(paper_gate());
  bool silent = false;         // if true, read() returns the last reading again
  int delay = 0;               // [cycles]
  double period = 0.0;         // [s] cycle period for which the lever was last opened
  int opened = 0, driven = 0;  // how many levers were opened, and how many readings were taken
  glm::dvec2 force{0.0};       // [N] the latest command
  double strongest = 0.0;      // [N] magnitude of the largest command so far
  bool on = false;             // whether the motors are on
};

// The simulated lever, presented to the runtime as a real device.
class HeldLever final : public HapticDevice {
 public:
  HeldLever(Stick& stick, double period)
      : stick_(stick), lever_(config(stick), std::llround(1e9 * period), stick.hand), spec_(lever_.spec()) {
    spec_.simulated = spec_.measures_hand_force = false;
    spec_.yoke_radius = 0.0;  // this lever moves in a plane
    lever_.place({0.0, 0.003});
  }
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override {
    ++stick_.driven;
    const LeverReading now = lever_.read(now_ns);
    if (!stick_.silent) last_ = now;
    return last_;
  }
  void switch_on() noexcept override { stick_.on = true; }
  void write(glm::dvec2 force) noexcept override {
    stick_.force = force;
    stick_.strongest = std::max(stick_.strongest, glm::length(force));
    lever_.write(force);
  }
  void release() noexcept override {
    stick_.force = {};
    stick_.on = false;
    lever_.release();
  }

 private:
  static SimulatedLeverConfig config(const Stick& stick) {
    SimulatedLeverConfig config;
    config.hand = kGripHand;
    config.delay = stick.delay;
    return config;
  }
  Stick& stick_;
  SimulatedLever lever_;
  DeviceSpec spec_;
  LeverReading last_;
};

RuntimeConfig held(Stick& stick) {
  RuntimeConfig config = runtime_config(RuntimeClock::virtual_time);
  config.lever = [&stick](double period) -> std::unique_ptr<HapticDevice> {
    ++stick.opened;
    stick.period = period;
    return std::make_unique<HeldLever>(stick, period);
  };
  return config;
}

}  // namespace

TEST_CASE("frame input does not move the lever, and no force acts until the user arms it") {
  Stick stick;
  Runtime runtime(held(stick));
  CHECK(stick.period == 1e-3);
  HandTarget elsewhere;
  elsewhere.position = {0.05, 0.05};
  elsewhere.push = {50.0, 50.0};
  runtime.set_hand(elsewhere);
  runtime.advance(0.001);
  // The lever is still where it was opened, within 0.2 mm: less than three counts of its encoder.
  CHECK(glm::distance(runtime.snapshot().lever, glm::dvec2(0.0, 0.003)) < 2e-4);
  runtime.advance(20.0);  // the hand moves through all gears
  CHECK(runtime.snapshot().guard == GuardState::idle);
  CHECK(stick.strongest == 0.0);
  CHECK((runtime.snapshot().flags & kFlagPushEstimated) != 0);
}

TEST_CASE("the user's hand shifts through every gear, as on the simulated lever") {
  Stick stick;
  Runtime runtime(held(stick));
  runtime.arm();
  runtime.advance(stick.hand.duration());
  std::vector<int> gears;
  add_gears(runtime.read_frame().events, gears);
  CHECK(gears == kPaperTour);
  CHECK(stick.strongest > 5.0);
}

TEST_CASE("after a fault only the user restores the forces") {
  Stick stick;
  Runtime runtime(held(stick));
  runtime.arm();
  runtime.advance(1.0);
  REQUIRE(runtime.snapshot().guard == GuardState::running);
  stick.silent = true;
  runtime.advance(0.2);
  CHECK(runtime.snapshot().fault == GuardFault::stale_reading);
  CHECK(stick.force == glm::dvec2(0.0));
  stick.silent = false;
  runtime.advance(5.0);
  const GuardState after = runtime.snapshot().guard;
  CHECK((after == GuardState::damped || after == GuardState::released));
  runtime.arm();
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::running);
}

TEST_CASE("a recording that begins during or after a fault does not restore forces; the user does") {
  for (const double after : {0.005, 0.5}) {  // [s] 0.005: while the last force fades out; 0.5: long afterwards
    CAPTURE(after);
    const TempFolder folder;
    Stick stick;
    Runtime runtime(held(stick));
    runtime.arm();
    runtime.advance(1.0);
    REQUIRE(stick.on);
    stick.silent = true;
    while (runtime.snapshot().guard == GuardState::running) runtime.advance(0.001);
    stick.silent = false;
    runtime.advance(after);
    runtime.start_recording(folder / "after.trace");
    runtime.advance(0.001);
    stick.strongest = 0.0;
    CHECK_FALSE(stick.on);
    runtime.advance(1.0);
    CHECK_FALSE(runtime.stop_recording().has_value());
    runtime.advance(1.0);
    CHECK(stick.strongest == 0.0);
    CHECK_FALSE(stick.on);
    runtime.arm();
    runtime.advance(1.0);
    CHECK(runtime.snapshot().guard == GuardState::running);
  }
}

TEST_CASE("a recording begun during a run, with a fault in it, replays bit for bit: the trace contains the device") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "held.trace";
  Stick stick;
  Runtime runtime(held(stick));
  runtime.arm();
  runtime.advance(2.0);
  runtime.start_recording(file);
  runtime.advance(3.0);
  stick.silent = true;
  runtime.advance(0.1);
  stick.silent = false;
  runtime.advance(0.5);
  runtime.arm();
  runtime.advance(1.0);
  CHECK_FALSE(runtime.stop_recording().has_value());
  const ReplayResult replayed = replay(read_trace(file));
  CHECK(replayed.bit_for_bit());
  CHECK(replayed.cycles > 4500);
}

TEST_CASE("with 3 cycles of delay, the stability law lowers the wall stiffness, and this is reported") {
  Stick stick;
  stick.delay = 3;
  const Runtime runtime(held(stick));
  const AdmittedTuning& admitted = runtime.admitted();
  const double tau = 4e-3, mass = kPaperAxisY.mass;  // tau [s]: (3 + 1) cycles; mass [kg]: of the lighter axis
  const double fraction = admitted.hold == ContactHold::observer ? 0.58 : 0.35;
  CHECK(admitted.tuning.wall_stiffness <= fraction * mass / (tau * tau) * (1.0 + 1e-9));
  CHECK_FALSE(admitted.limits.empty());
}

TEST_CASE("an invalid setup is rejected before the lever is opened, and a mere check opens nothing") {
  Stick stick;
  (void)check_runtime(held(stick));
  RuntimeConfig driven = held(stick);
  driven.driver = [](const DriveSample&) { return DriverAction{}; };
  CHECK_THROWS_AS((void)check_runtime(driven), std::invalid_argument);
  CHECK_THROWS_AS(Runtime{driven}, std::invalid_argument);
  RuntimeConfig study = held(stick);
  study.preset.haptics.contact.allow_unstable = true;  // not allowed on a lever that a user holds
  CHECK_THROWS_AS((void)check_runtime(study), std::invalid_argument);
  CHECK_THROWS_AS(Runtime{study}, std::invalid_argument);
  CHECK(stick.driven == 0);
}

// The watch is that of the controls, not of a frame: here no frame comes at all.
TEST_CASE("a stick's forces end 0.2 s after its user's controls were last read, and at STOP from any thread") {
  for (const bool stops : {false, true}) {
    CAPTURE(stops);
    Stick stick;
    RuntimeConfig config = held(stick);
    config.clock = RuntimeClock::real_time;
    config.watch = std::make_shared<ControlsWatch>();
    config.watch->stop();  // this was for an earlier lever
    Runtime runtime(config);
    const auto reads_until_running = [&] {
      for (int i = 0; i < 5000 && runtime.snapshot().guard != GuardState::running; ++i) {
        config.watch->note_read(monotonic_ns());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    };
    runtime.arm();
    reads_until_running();
    CHECK(runtime.snapshot().guard == GuardState::running);
    CHECK_FALSE(config.watch->take_lapse());
    const std::int64_t last_ns = monotonic_ns();
    config.watch->note_read(last_ns);
    if (stops) config.watch->stop();
    while (runtime.snapshot().guard == GuardState::running && monotonic_ns() - last_ns < 2'000'000'000)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const HapticSnapshot ended = runtime.snapshot();
    CHECK(ended.guard == GuardState::released);
    CHECK(ended.fault == GuardFault::stopped);
    CHECK_FALSE(stick.on);
    if (!stops) CHECK(ended.time_ns - last_ns >= 200'000'000);
    CHECK(config.watch->take_lapse() == !stops);
    CHECK_FALSE(runtime.wants_forces());
    config.watch->note_read(monotonic_ns());
    runtime.arm();  // only the user turns them on again
    reads_until_running();
    CHECK(runtime.snapshot().guard == GuardState::running);
  }
}

TEST_CASE("a simulated lever, which cannot hurt anybody, keeps its forces while no controls are read") {
  RuntimeConfig config = runtime_config(RuntimeClock::real_time);
  config.watch = std::make_shared<ControlsWatch>();
  config.watch->note_read(monotonic_ns() - 1'000'000'000);
  Runtime runtime(config);
  runtime.arm();
  for (int i = 0; i < 5000 && runtime.snapshot().guard != GuardState::running; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(runtime.snapshot().guard == GuardState::running);
  config.watch->stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(runtime.snapshot().guard == GuardState::released);
}
