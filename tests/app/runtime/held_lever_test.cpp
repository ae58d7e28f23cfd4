// A lever held by a person: the program does not move it, only a person arms it, and its recordings replay.
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/runtime/runtime_rig.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// The state of the stick and its failures. It outlives the trainers.
struct Stick {
  ScriptedHand hand = tour_of(paper_gate());
  bool silent = false;       // no new readings
  int delay = 0;             // [cycles]
  double period = 0.0;       // [s] of the lever opened last
  int made = 0, driven = 0;  // number of levers opened, and of cycles read
  glm::dvec2 force{0.0};     // [N] the last command
  double strongest = 0.0;    // [N] the largest command so far
  bool on = false;           // whether its motors are on
};

// The simulated lever, presented as an ordinary device.
class HeldLever final : public HapticDevice {
 public:
  HeldLever(Stick& stick, double period)
      : stick_(stick), lever_(config(stick), std::llround(1e9 * period), stick.hand), spec_(lever_.spec()) {
    spec_.simulated = spec_.measures_hand_force = false;
    spec_.yoke_radius = 0.0;  // moves in a plane
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
    ++stick.made;
    stick.period = period;
    return std::make_unique<HeldLever>(stick, period);
  };
  return config;
}

}  // namespace

TEST_CASE("frame input does not move the lever, and it gets no force until a person arms it") {
  Stick stick;
  Runtime runtime(held(stick));
  CHECK(stick.period == 1e-3);
  HandTarget elsewhere;
  elsewhere.position = {0.05, 0.05};
  elsewhere.push = {50.0, 50.0};
  runtime.set_hand(elsewhere);
  runtime.advance(0.001);
  CHECK(glm::distance(runtime.snapshot().lever, glm::dvec2(0.0, 0.003)) < 2e-4);  // two counts of its encoder
  runtime.advance(20.0);                                                          // of a tour with forces off
  CHECK(runtime.snapshot().guard == GuardState::idle);
  CHECK(stick.strongest == 0.0);
  CHECK((runtime.snapshot().flags & kFlagPushEstimated) != 0);
}

TEST_CASE("its holder shifts through every gear, as on the simulated lever") {
  Stick stick;
  Runtime runtime(held(stick));
  runtime.arm();
  runtime.advance(stick.hand.duration());
  std::vector<int> gears;
  add_gears(runtime.drain_events(), gears);
  CHECK(gears == kPaperTour);
  CHECK(stick.strongest > 5.0);
}

TEST_CASE("after a fault only a person restores the forces") {
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

TEST_CASE("a recording that begins after a fault, or during it, does not restore forces: a person does") {
  for (const double after : {0.005, 0.5}) {  // while the last force fades, and long after
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

TEST_CASE("a recording begun while it runs, with a fault in it, replays bit for bit: the trace contains the device") {
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

TEST_CASE("3 cycles of delay: the wall is limited by the law of the hold, and this is reported") {
  Stick stick;
  stick.delay = 3;
  const Runtime runtime(held(stick));
  const AdmittedTuning& admitted = runtime.admitted();
  const double tau = 4e-3, mass = kPaperAxisY.mass;  // the lighter axis
  const double share = admitted.hold == ContactHold::observer ? 0.58 : 0.35;
  CHECK(admitted.tuning.wall_stiffness <= share * mass / (tau * tau) * (1.0 + 1e-9));
  CHECK_FALSE(admitted.limits.empty());
}

TEST_CASE("an invalid setup is rejected before the lever is opened, and a check alone opens nothing") {
  Stick stick;
  (void)check_runtime(held(stick));
  RuntimeConfig driven = held(stick);
  driven.driver = [](const DriveSample&) { return DriverAction{}; };
  CHECK_THROWS_AS((void)check_runtime(driven), std::invalid_argument);
  CHECK_THROWS_AS(Runtime{driven}, std::invalid_argument);
  RuntimeConfig study = held(stick);
  study.preset.haptics.contact.allow_unstable = true;  // which is not safe for a person to touch
  CHECK_THROWS_AS((void)check_runtime(study), std::invalid_argument);
  CHECK_THROWS_AS(Runtime{study}, std::invalid_argument);
  CHECK(stick.driven == 0);
}
