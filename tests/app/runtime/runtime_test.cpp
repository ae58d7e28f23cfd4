// The runtime on a virtual clock: its lever is moved, armed, tuned and observed.
#include "app/runtime/runtime.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/preset.h"
#include "haptics/loop/shift_script.h"
#include "tests/app/runtime/runtime_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// Moves the lever forward into third gear and against its end stop at 40 mm: the hand's target is at 60 mm.
void press_wall(Runtime& runtime) {
  HandTarget target;
  target.position = {0.0, 0.06};
  runtime.set_hand(target);
  runtime.advance(1.0);
}

}  // namespace

TEST_CASE("moved at 60 frames per second through any shipped gate, the gears engage in order, and no others") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Runtime runtime(runtime_config(RuntimeClock::virtual_time, name));
    runtime.arm();
    std::vector<int> gears;
    LeadingPerson person(runtime, [&] {
      runtime.advance(LeadingPerson::kFrame);
      add_gears(runtime.read_frame().events, gears);
    });
    const std::vector<int> wanted = tour_order(runtime.gate());
    for (const int gear : wanted) {
      CAPTURE(gear);
      person.shift_to(gear);
      CHECK(runtime.snapshot().gear == gear);
    }
    CHECK(gears == wanted);
    CHECK(runtime.health().lost == 0);
    if (name == "paper") CHECK(gears == kPaperTour);
  }
}

TEST_CASE("two equal drives are bit-identical") {
  HapticSnapshot last[2];
  for (HapticSnapshot& snapshot : last) {
    Runtime runtime(runtime_config(RuntimeClock::virtual_time));
    runtime.arm();
    LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
    for (const int gear : {1, 4}) person.shift_to(gear);
    snapshot = runtime.snapshot();
  }
  CHECK(last[0].lever == last[1].lever);
  CHECK(last[0].commanded == last[1].commanded);
  CHECK(last[0].cycle == last[1].cycle);
}

TEST_CASE("the runtime begins in neutral, disarmed, in any gate") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Runtime runtime(runtime_config(RuntimeClock::virtual_time, name));
    const glm::dvec2 rest = rest_position(runtime.gate(), kNeutralGear);
    CHECK(runtime.snapshot().lever == rest);
    runtime.advance(0.5);
    CHECK(glm::distance(runtime.snapshot().lever, rest) < 0.001);
    CHECK(runtime.snapshot().guard == GuardState::idle);
    CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
  }
}

TEST_CASE("arm, disarm and stop: forces ramp up in half a second and are gone in the next cycle") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  press_wall(runtime);
  CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
  runtime.arm();
  runtime.advance(0.1);
  CHECK(runtime.snapshot().guard == GuardState::ramping);
  runtime.advance(0.9);
  CHECK(runtime.snapshot().guard == GuardState::running);
  CHECK(std::abs(runtime.snapshot().commanded.y) > 2.0);
  runtime.disarm();
  runtime.advance(0.001);
  CHECK(runtime.snapshot().guard == GuardState::idle);
  CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
  runtime.arm();
  runtime.advance(1.0);
  runtime.stop();
  runtime.advance(0.001);
  CHECK(runtime.snapshot().guard == GuardState::released);
  CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::released);  // only the user can arm the lever again
  runtime.arm();
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::running);
}

TEST_CASE("the last command wins, however many are waiting while the clock does not advance") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  for (int i = 0; i < 100; ++i) runtime.arm();
  runtime.stop();
  runtime.advance(0.1);
  CHECK(runtime.snapshot().guard == GuardState::released);
}

TEST_CASE("the wall holds a lever that the hand pulls through it; without forces it does not") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  runtime.advance(1.0);
  press_wall(runtime);
  const HapticSnapshot held = runtime.snapshot();
  CHECK(held.lever.y < 0.043);
  CHECK(held.proxy.y <= 0.040 + 1e-9);
  CHECK((held.flags & kFlagContact) != 0);
  CHECK(held.gear == 3);
  runtime.disarm();
  runtime.advance(1.0);
  CHECK(runtime.snapshot().lever.y > 0.055);
  CHECK(runtime.snapshot().proxy.y <= 0.040 + 1e-9);  // even without forces, the proxy stays in the gate
}

TEST_CASE("a changed tuning is limited, used and stored; values out of range change nothing") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.advance(0.1);
  HapticTuning wanted = runtime.admitted().tuning;
  wanted.wall_stiffness = 4500.0;
  CHECK((runtime.change_tuning(wanted).tuning == wanted));
  runtime.advance(0.01);
  CHECK(runtime.snapshot().wall_stiffness == 4500.0);
  CHECK((runtime.config().preset.haptics.tuning == wanted));
  CHECK((runtime.admitted().tuning == wanted));

  HapticTuning soft = wanted;
  soft.wall_stiffness = 1000.0;  // [N/m] softer than the gate's feel allows, so `feel_scale` is limited
  const AdmittedTuning admitted = runtime.change_tuning(soft);
  CHECK(admitted.tuning.feel_scale < 1.0);
  CHECK(admitted.limits.size() == 1);
  CHECK((runtime.config().preset.haptics.tuning == soft));  // the configuration keeps the requested tuning
  CHECK((runtime.admitted().tuning == admitted.tuning));

  HapticTuning impossible = wanted;
  impossible.wall_damping = -1.0;
  CHECK_THROWS_AS(runtime.change_tuning(impossible), std::invalid_argument);
  CHECK((runtime.config().preset.haptics.tuning == soft));
}

TEST_CASE("a hand too soft to move the lever is replaced by a grip, and the configuration shows it") {
  RuntimeConfig config = runtime_config(RuntimeClock::virtual_time);
  config.preset.lever.hand = kBareHand;
  CHECK(Runtime(config).config().preset.lever.hand.stiffness == kGripHand.stiffness);
  config.preset.lever.hand = kLightHand;
  CHECK(Runtime(config).config().preset.lever.hand.stiffness == kLightHand.stiffness);
}

TEST_CASE("the virtual clock advances by whole cycles and carries the remainder") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  CHECK(runtime.time() == 0.0);
  for (int i = 0; i < 60; ++i) runtime.advance(1.0 / 60.0);
  CHECK(runtime.time() == doctest::Approx(1.0).epsilon(1e-12));
  for (int i = 0; i < 10; ++i) runtime.advance(0.0001);
  CHECK(runtime.time() == doctest::Approx(1.001).epsilon(1e-12));
  runtime.advance(-1.0);
  runtime.advance(std::numeric_limits<double>::quiet_NaN());
  runtime.advance(std::numeric_limits<double>::infinity());
  CHECK(runtime.time() == doctest::Approx(1.001).epsilon(1e-12));
  CHECK(runtime.read_frame().cycles.size() == 1001);
}

TEST_CASE("every cycle since the last call is returned once, in order") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.advance(0.25);
  const std::vector<DriveSample> first = runtime.read_frame().cycles;
  (void)runtime.health();  // health() must not consume cycles
  DriverControls controls;
  controls.pedals.clutch = 0.25;
  runtime.set_controls(controls);
  runtime.advance(3.0);
  (void)runtime.health();
  const std::vector<DriveSample> second = runtime.read_frame().cycles;
  CHECK(first.size() == 250);
  CHECK(second.size() == 3000);
  std::uint64_t next = 0;
  for (const auto* part : {&first, &second})
    for (const DriveSample& sample : *part) {
      CHECK(sample.lever.cycle == next++);
      CHECK(sample.controls.pedals.clutch == (part == &first ? 0.0 : 0.25));
    }
  CHECK(second.back().lever.time_ns == runtime.snapshot().time_ns);
  CHECK(runtime.read_frame().cycles.empty());
}

TEST_CASE("after too long a pause the first 8192 cycles are kept, and the gap is visible") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.advance(0.5);
  CHECK(runtime.read_frame().cycles.size() == 500);
  runtime.advance(20.0);
  const std::vector<DriveSample> cycles = runtime.read_frame().cycles;
  REQUIRE(cycles.size() == 8192);
  CHECK(cycles.front().lever.cycle == 500);
  CHECK(cycles.back().lever.cycle == 500 + 8191);
  runtime.advance(0.001);
  const std::vector<DriveSample> next = runtime.read_frame().cycles;
  REQUIRE(next.size() == 1);
  CHECK(next[0].lever.cycle == 20'500);
}

TEST_CASE("health reports the rate, and each stage's fraction of a cycle") {
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.advance(1.0);
  (void)runtime.read_frame();
  const LoopHealth& health = runtime.health();
  CHECK(health.rate == 1000.0);
  CHECK(health.overruns == 0);
  CHECK(health.late_worst == 0.0);
  CHECK_FALSE(health.realtime);
  CHECK_FALSE(health.not_realtime_reason.empty());
  double sum = 0.0;
  for (const double stage : health.stage_ns) {
    CHECK(stage >= 0.0);
    sum += stage;
  }
  CHECK(health.cycle_ns > 0.0);
  CHECK(health.cycle_ns == doctest::Approx(sum));
}

TEST_CASE("an invalid configuration is rejected with one sentence") {
  RuntimeConfig config = runtime_config(RuntimeClock::virtual_time);
  config.preset.haptics.rate = 0.0;
  CHECK_THROWS_AS(Runtime{config}, std::invalid_argument);
  config = runtime_config(RuntimeClock::virtual_time);
  config.preset.lever.yoke.radius = 0.03;  // the gate does not fit into such a small yoke
  CHECK_THROWS_AS(Runtime{config}, std::runtime_error);
}
