// The running lever on its virtual clock: led, armed, tuned, looked at.
#include "app/trainer/trainer.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/preset.h"
#include "haptics/loop/shift_script.h"
#include "tests/app/trainer/trainer_bench.h"

using namespace gearshift;

namespace {

// Leads the lever forward into third gear and 20 mm beyond its end stop, which is at 40 mm.
void press_wall(Trainer& trainer) {
  HandTarget target;
  target.position = {0.0, 0.06};
  trainer.set_hand(target);
  trainer.advance(1.0);
}

}  // namespace

TEST_CASE("led through any shipped gate at 60 frames a second, the gears engage in order, and no other") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Trainer trainer(trainer_config(TrainerClock::virtual_time, name));
    trainer.arm();
    std::vector<int> gears;
    LeadingPerson person(trainer, [&] {
      trainer.advance(LeadingPerson::kFrame);
      add_gears(trainer.take_events(), gears);
    });
    const std::vector<int> wanted = tour_order(trainer.gate());
    for (const int gear : wanted) {
      CAPTURE(gear);
      person.shift_to(gear);
      CHECK(trainer.snapshot().gear == gear);
    }
    CHECK(gears == wanted);
    CHECK(trainer.health().events_lost == 0);
    if (name == "paper") CHECK(gears == kPaperTour);
  }
}

TEST_CASE("two such drives are the same to the bit") {
  HapticSnapshot last[2];
  for (HapticSnapshot& snapshot : last) {
    Trainer trainer(trainer_config(TrainerClock::virtual_time));
    trainer.arm();
    LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
    for (const int gear : {1, 4}) person.shift_to(gear);
    snapshot = trainer.snapshot();
  }
  CHECK(last[0].lever == last[1].lever);
  CHECK(last[0].commanded == last[1].commanded);
  CHECK(last[0].cycle == last[1].cycle);
}

TEST_CASE("it begins at neutral, disarmed, whatever the gate") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Trainer trainer(trainer_config(TrainerClock::virtual_time, name));
    const glm::dvec2 rest = rest_position(trainer.gate(), kNeutralGear);
    CHECK(trainer.snapshot().lever == rest);
    trainer.advance(0.5);
    CHECK(glm::distance(trainer.snapshot().lever, rest) < 0.001);
    CHECK(trainer.snapshot().guard == GuardState::idle);
    CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
  }
}

TEST_CASE("arm, disarm and stop: forces ramp up in half a second and are gone in the next cycle") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  press_wall(trainer);
  CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
  trainer.arm();
  trainer.advance(0.1);
  CHECK(trainer.snapshot().guard == GuardState::ramping);
  trainer.advance(0.9);
  CHECK(trainer.snapshot().guard == GuardState::running);
  CHECK(std::abs(trainer.snapshot().commanded.y) > 2.0);
  trainer.disarm();
  trainer.advance(0.001);
  CHECK(trainer.snapshot().guard == GuardState::idle);
  CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
  trainer.arm();
  trainer.advance(1.0);
  trainer.stop();
  trainer.advance(0.001);
  CHECK(trainer.snapshot().guard == GuardState::released);
  CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::released);  // only a person ends that
  trainer.arm();
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::running);
}

TEST_CASE("the last command wins, however many wait on a clock that stands") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  for (int i = 0; i < 100; ++i) trainer.arm();
  trainer.stop();
  trainer.advance(0.1);
  CHECK(trainer.snapshot().guard == GuardState::released);
}

TEST_CASE("the wall holds the lever that the hand pulls through it; without forces it does not") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  trainer.advance(1.0);
  press_wall(trainer);
  const HapticSnapshot held = trainer.snapshot();
  CHECK(held.lever.y < 0.043);
  CHECK(held.proxy.y <= 0.040 + 1e-9);
  CHECK((held.flags & kFlagContact) != 0);
  CHECK(held.gear == 3);
  trainer.disarm();
  trainer.advance(1.0);
  CHECK(trainer.snapshot().lever.y > 0.055);
  CHECK(trainer.snapshot().proxy.y <= 0.040 + 1e-9);  // what is drawn stays in the gate
}

TEST_CASE("a changed tuning is admitted, used and kept; what is out of range changes nothing") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.advance(0.1);
  HapticTuning wanted = trainer.admitted().tuning;
  wanted.wall_stiffness = 4500.0;
  CHECK((trainer.change_tuning(wanted).tuning == wanted));
  trainer.advance(0.01);
  CHECK(trainer.snapshot().wall_stiffness == 4500.0);
  CHECK((trainer.config().preset.haptics.tuning == wanted));
  CHECK((trainer.admitted().tuning == wanted));

  HapticTuning soft = wanted;
  soft.wall_stiffness = 1000.0;  // softer than the gate's feel: that is limited
  const AdmittedTuning admitted = trainer.change_tuning(soft);
  CHECK(admitted.tuning.feel_scale < 1.0);
  CHECK(admitted.limited.size() == 1);
  CHECK((trainer.config().preset.haptics.tuning == soft));  // as wanted
  CHECK((trainer.admitted().tuning == admitted.tuning));

  HapticTuning impossible = wanted;
  impossible.wall_damping = -1.0;
  CHECK_THROWS_AS(trainer.change_tuning(impossible), std::invalid_argument);
  CHECK((trainer.config().preset.haptics.tuning == soft));
}

TEST_CASE("a hand too soft to lead is replaced by a grip, and the configuration says so") {
  TrainerConfig config = trainer_config(TrainerClock::virtual_time);
  config.preset.lever.hand = kBareHand;
  CHECK(Trainer(config).config().preset.lever.hand.stiffness == kGripHand.stiffness);
  config.preset.lever.hand = kLightHand;
  CHECK(Trainer(config).config().preset.lever.hand.stiffness == kLightHand.stiffness);
}

TEST_CASE("the virtual clock moves by whole cycles and owes the rest") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  CHECK(trainer.time() == 0.0);
  for (int i = 0; i < 60; ++i) trainer.advance(1.0 / 60.0);
  CHECK(trainer.time() == doctest::Approx(1.0).epsilon(1e-12));
  for (int i = 0; i < 10; ++i) trainer.advance(0.0001);
  CHECK(trainer.time() == doctest::Approx(1.001).epsilon(1e-12));
  trainer.advance(-1.0);
  trainer.advance(std::numeric_limits<double>::quiet_NaN());
  trainer.advance(std::numeric_limits<double>::infinity());
  CHECK(trainer.time() == doctest::Approx(1.001).epsilon(1e-12));
  CHECK(trainer.take_cycles().size() == 1001);
}

TEST_CASE("every cycle since the last look is handed out, in order, each once") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.advance(0.25);
  const std::vector<DriveSample> first = trainer.take_cycles();
  (void)trainer.health();  // looks, and takes none
  DriverControls controls;
  controls.clutch = 0.25;
  trainer.set_controls(controls);
  trainer.advance(3.0);
  (void)trainer.health();
  const std::vector<DriveSample> second = trainer.take_cycles();
  CHECK(first.size() == 250);
  CHECK(second.size() == 3000);
  std::uint64_t next = 0;
  for (const auto* part : {&first, &second})
    for (const DriveSample& sample : *part) {
      CHECK(sample.lever.cycle == next++);
      CHECK(sample.controls.clutch == (part == &first ? 0.0 : 0.25));
    }
  CHECK(second.back().lever.time_ns == trainer.snapshot().time_ns);
  CHECK(trainer.take_cycles().empty());
}

TEST_CASE("a pause that is too long keeps its first 8192 cycles, and the gap shows") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.advance(0.5);
  CHECK(trainer.take_cycles().size() == 500);
  trainer.advance(20.0);
  const std::vector<DriveSample> cycles = trainer.take_cycles();
  REQUIRE(cycles.size() == 8192);
  CHECK(cycles.front().lever.cycle == 500);
  CHECK(cycles.back().lever.cycle == 500 + 8191);
  trainer.advance(0.001);
  const std::vector<DriveSample> next = trainer.take_cycles();
  REQUIRE(next.size() == 1);
  CHECK(next[0].lever.cycle == 20'500);
}

TEST_CASE("health tells the rate, and each stage's share of a cycle") {
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.advance(1.0);
  const LoopHealth health = trainer.health();
  CHECK(health.rate == 1000.0);
  CHECK(health.overruns == 0);
  CHECK(health.late_worst == 0.0);
  CHECK_FALSE(health.realtime);
  CHECK_FALSE(health.why_not.empty());
  double sum = 0.0;
  for (const double stage : health.stage_ns) {
    CHECK(stage >= 0.0);
    sum += stage;
  }
  CHECK(health.cycle_ns > 0.0);
  CHECK(health.cycle_ns == doctest::Approx(sum));
}

TEST_CASE("what cannot run is refused with one sentence") {
  TrainerConfig config = trainer_config(TrainerClock::virtual_time);
  config.preset.haptics.rate = 0.0;
  CHECK_THROWS_AS(Trainer{config}, std::invalid_argument);
  config = trainer_config(TrainerClock::virtual_time);
  config.preset.lever.yoke.radius = 0.03;  // the gate does not fit
  CHECK_THROWS_AS(Trainer{config}, std::runtime_error);
}
