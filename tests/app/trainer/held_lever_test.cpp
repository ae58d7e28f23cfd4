// A lever that somebody holds: nothing leads it from here, nobody arms it but a person, and its recordings replay.
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
#include "tests/app/trainer/trainer_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

// What somebody does with the stick, and what is wrong with it. It outlives the trainers.
struct Stick {
  ScriptedHand hand = tour_of(paper_gate());
  bool silent = false;       // no new readings
  int delay = 0;             // [cycles]
  double period = 0.0;       // [s] of the last lever that was made
  int made = 0, driven = 0;  // levers; times that one was read
  glm::dvec2 force{0.0};     // [N] as written last
  double strongest = 0.0;    // [N] ever
  bool on = false;           // its motors
};

// The simulated lever as a device that nobody knows to be simulated.
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

TrainerConfig held(Stick& stick) {
  TrainerConfig config = trainer_config(TrainerClock::virtual_time);
  config.lever = [&stick](double period) -> std::unique_ptr<HapticDevice> {
    ++stick.made;
    stick.period = period;
    return std::make_unique<HeldLever>(stick, period);
  };
  return config;
}

}  // namespace

TEST_CASE(
    "the lever stays where it is, however the hand of the frame is led, and gets no force until a person arms it") {
  Stick stick;
  Trainer trainer(held(stick));
  CHECK(stick.period == 1e-3);
  HandTarget elsewhere;
  elsewhere.position = {0.05, 0.05};
  elsewhere.push = {50.0, 50.0};
  trainer.set_hand(elsewhere);
  trainer.advance(0.001);
  CHECK(glm::distance(trainer.snapshot().lever, glm::dvec2(0.0, 0.003)) < 2e-4);  // two counts of its encoder
  trainer.advance(20.0);                                                          // of a tour without forces
  CHECK(trainer.snapshot().guard == GuardState::idle);
  CHECK(stick.strongest == 0.0);
  CHECK((trainer.snapshot().flags & kFlagPushEstimated) != 0);
}

TEST_CASE("who holds it shifts through every gear, as on the simulated lever") {
  Stick stick;
  Trainer trainer(held(stick));
  trainer.arm();
  trainer.advance(stick.hand.duration());
  std::vector<int> gears;
  add_gears(trainer.take_events(), gears);
  CHECK(gears == kPaperTour);
  CHECK(stick.strongest > 5.0);
}

TEST_CASE("after a fault nobody gives the forces back but a person") {
  Stick stick;
  Trainer trainer(held(stick));
  trainer.arm();
  trainer.advance(1.0);
  REQUIRE(trainer.snapshot().guard == GuardState::running);
  stick.silent = true;
  trainer.advance(0.2);
  CHECK(trainer.snapshot().fault == GuardFault::stale_reading);
  CHECK(stick.force == glm::dvec2(0.0));
  stick.silent = false;
  trainer.advance(5.0);
  const GuardState after = trainer.snapshot().guard;
  CHECK((after == GuardState::damped || after == GuardState::released));
  trainer.arm();
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::running);
}

TEST_CASE("a recording that begins after a fault, or in the middle of it, gives no forces back: a person does") {
  for (const double after : {0.005, 0.5}) {  // while the last force dies away, and long after
    CAPTURE(after);
    const TempFolder folder;
    Stick stick;
    Trainer trainer(held(stick));
    trainer.arm();
    trainer.advance(1.0);
    REQUIRE(stick.on);
    stick.silent = true;
    while (trainer.snapshot().guard == GuardState::running) trainer.advance(0.001);
    stick.silent = false;
    trainer.advance(after);
    trainer.start_recording(folder / "after.trace");
    trainer.advance(0.001);
    stick.strongest = 0.0;
    CHECK_FALSE(stick.on);
    trainer.advance(1.0);
    CHECK_FALSE(trainer.stop_recording().has_value());
    trainer.advance(1.0);
    CHECK(stick.strongest == 0.0);
    CHECK_FALSE(stick.on);
    trainer.arm();
    trainer.advance(1.0);
    CHECK(trainer.snapshot().guard == GuardState::running);
  }
}

TEST_CASE("a recording begun while it runs, with a fault in it, replays bit for bit: the device is in the trace") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "held.trace";
  Stick stick;
  Trainer trainer(held(stick));
  trainer.arm();
  trainer.advance(2.0);
  trainer.start_recording(file);
  trainer.advance(3.0);
  stick.silent = true;
  trainer.advance(0.1);
  stick.silent = false;
  trainer.advance(0.5);
  trainer.arm();
  trainer.advance(1.0);
  CHECK_FALSE(trainer.stop_recording().has_value());
  const ReplayResult replayed = replay(read_trace(file));
  CHECK(replayed.bit_for_bit());
  CHECK(replayed.cycles > 4500);
}

TEST_CASE("3 cycles of delay: less wall than wanted is admitted, by the law of the hold, and told") {
  Stick stick;
  stick.delay = 3;
  const Trainer trainer(held(stick));
  const AdmittedTuning& admitted = trainer.admitted();
  const double tau = 4e-3, mass = kPaperAxisY.mass;  // the lighter axis
  const double share = admitted.hold == ContactHold::observer ? 0.58 : 0.35;
  CHECK(admitted.tuning.wall_stiffness <= share * mass / (tau * tau) * (1.0 + 1e-9));
  CHECK_FALSE(admitted.limited.empty());
}

TEST_CASE("what is refused is refused before the lever is driven, and what is allowed drives nothing either") {
  Stick stick;
  (void)check_trainer(held(stick));
  TrainerConfig driven = held(stick);
  driven.driver = [](const DriveSample&) { return DriverAction{}; };
  CHECK_THROWS_AS((void)check_trainer(driven), std::invalid_argument);
  CHECK_THROWS_AS(Trainer{driven}, std::invalid_argument);
  TrainerConfig study = held(stick);
  study.preset.haptics.contact.study = true;  // a person must not touch it
  CHECK_THROWS_AS((void)check_trainer(study), std::invalid_argument);
  CHECK_THROWS_AS(Trainer{study}, std::invalid_argument);
  CHECK(stick.driven == 0);
}
