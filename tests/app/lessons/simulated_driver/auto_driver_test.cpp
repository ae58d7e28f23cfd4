// A simulated driver replaces the learner. It drives lessons by itself, repeatedly, and in every shipped gate.
#include "app/lessons/simulated_driver/auto_driver.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lessons/assessment/lesson_run.h"
#include "app/vehicle/car_load.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/simulated_run.h"
#include "tests/app/lessons/simulated_driver/lessons.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// A minimal runtime: lever, loop and car. It is driven only by the simulated driver's actions.
class Rig final : public HandDriver {
 public:
  Rig(const AutoDriverConfig& config, const LessonStart& start)
      : car_(config.car, config.gate, 31.7, car_start(start)),
        run_(setup(config.gate, start), *this, &car_),
        driver_(config) {
    now_.controls.ignition = start.running;
    now_.controls.pedals.hand_brake = start.hand_brake;
    now_.controls.slope = start.slope;
    action_.hand.position = rest_position(config.gate, start.gear);
  }

  HandTarget next(double, glm::dvec2) noexcept override { return action_.hand; }

  const DriveSample& step() {
    run_.inputs().controls.write(now_.controls);
    now_.lever = run_.step();
    now_.car = car_.state();
    shown_ = now_;
    action_ = driver_.act(now_);
    fastest_foot_ = std::max({fastest_foot_, std::abs(action_.controls.pedals.clutch - now_.controls.pedals.clutch),
                              std::abs(action_.controls.pedals.brake - now_.controls.pedals.brake)});
    now_.controls = action_.controls;
    return shown_;
  }
  AutoDriver& driver() { return driver_; }
  double time() const { return run_.time(); }
  double fastest_foot() const { return fastest_foot_; }  // [1] the largest pedal movement within one cycle

 private:
  static CarStart car_start(const LessonStart& start) {
    CarStart from;
    from.gear = start.gear;
    from.road_speed = start.speed;
    from.running = start.running;
    return from;
  }
  static SimulatedRunConfig setup(const Gate& gate, const LessonStart& start) {
    SimulatedRunConfig config;
    config.haptics.guard.ramp_time = 0.01;
    config.gate = gate;
    config.start = rest_position(gate, start.gear);
    config.lever.hand = kGripHand;
    return config;
  }

  CarLoad car_;
  SimulatedRun run_;
  AutoDriver driver_;
  DriveSample now_, shown_;
  DriverAction action_;
  double fastest_foot_ = 0.0;
};

AutoDriverConfig config_of(const LessonDriveConfig& drive) {
  IdleHand idle_hand;
  const DeviceSpec device = SimulatedLever(SimulatedLeverConfig{}, 1'000'000, idle_hand).spec();
  AutoDriverConfig config;
  config.lesson = drive.lesson;
  config.car = drive.car;
  config.gate = compile_gate(drive.gate, device.workspace, device.yoke_radius);
  return config;
}

CarSpec car_for(const Gate& gate) {
  const bool six = slot_of_gear(gate, 6) != kNoSlot;
  return read_car(GEARSHIFT_ASSETS "/cars/" + std::string(six ? "diesel" : "hatchback") + ".toml");
}

// The gears that a tour through the gate engages, in order, without the neutral between two gears.
std::vector<int> gears_of_tour(const Gate& gate) {
  std::vector<int> up;
  for (int gear = 1; slot_of_gear(gate, gear) != kNoSlot; ++gear) up.push_back(gear);
  std::vector<int> all = up;
  for (std::size_t i = up.size() - 1; i-- > 1;) all.push_back(up[i]);
  if (slot_of_gear(gate, kReverseGear) != kNoSlot) all.push_back(kReverseGear);
  return all;
}

}  // namespace

TEST_CASE("the tour goes through every gear of every shipped gate, up, down and back, without an error") {
  const std::uint64_t seeds = is_full_campaign() ? 3 : 1;
  for (const std::string& name : shipped_names()) {
    if (name == "seven_speed") continue;  // no shipped car has seven gears
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      LessonDriveConfig drive;
      drive.gate = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + name + ".toml");
      const Gate gate = shipped_gate(name);
      drive.car = car_for(gate);
      drive.lesson = tour_lesson(drive.car, gate);
      drive.seed = seed;
      std::vector<int> gears;
      double fastest = 0.0;
      drive.on_cycle = [&](const DriveSample& s) {
        const int gear = s.car.gear;
        if (gear != kNeutralGear && (gears.empty() || gears.back() != gear)) gears.push_back(gear);
        fastest = std::max(fastest, s.car.road_speed);
      };
      const LessonResult result = drive_lesson(drive);
      CAPTURE(name);
      CAPTURE(seed);
      CAPTURE(error_list(result));
      CAPTURE(result.why);
      CHECK(result.passed);
      CHECK(result.grade == 10.0);
      CHECK(gears == gears_of_tour(gate));
      CHECK(result.duration < 120.0);
      CHECK(fastest < 100.0 / kKmhPerMps);
    }
  }
}

TEST_CASE("a simulated driver passes a lesson that is assessed at the same time, and then comes to rest") {
  for (const std::string_view key : {"hill_start", "up_through_the_gears", "start_and_stop"}) {
    const LessonDriveConfig drive = shipped_drive(key);
    const AutoDriverConfig config = config_of(drive);
    Rig rig(config, drive.lesson.start);
    LessonRun judge(drive.lesson, drive.car, config.gate, {LessonMode::follow_me, 0.0, HintStyle::prescriptive});
    while (!judge.is_over() && rig.time() < 200.0) judge.add(rig.step());
    CAPTURE(key);
    CAPTURE(judge.result().why);
    CHECK(judge.result().passed);
    CHECK(rig.driver().is_over());
    DriveSample last;
    for (int i = 0; i < 15'000; ++i) last = rig.step();
    CHECK(std::abs(last.car.road_speed) < 0.02);
    CHECK(last.car.stalled == false);
    CHECK(glm::length(last.lever.f_h) < 1.0);
  }
}

TEST_CASE("however a lesson ends, the next lap begins in the start state and ends well") {
  for (const std::string_view key : {"down_through_the_gears", "moving_off", "start_and_stop", "reverse"}) {
    const LessonDriveConfig drive = shipped_drive(key);
    AutoDriverConfig config = config_of(drive);
    config.again = true;
    Rig rig(config, drive.lesson.start);
    CAPTURE(key);
    for (int lap = 0; lap < 3; ++lap) {
      // The assessment begins once the car is in the lesson's start state.
      const LessonStart& start = drive.lesson.start;
      const auto at_start = [&](const DriveSample& s) {
        return s.car.gear == start.gear && s.car.running == start.running &&
               std::abs(s.car.pedals.hand_brake - start.hand_brake) < 0.1 &&
               s.car.road_speed > 0.9 * start.speed - 0.05 && (start.speed > 0.0 || s.car.road_speed < 0.05);
      };
      const double waited = rig.time();
      while (!at_start(rig.step()) && rig.time() < waited + 150.0) continue;
      REQUIRE(rig.time() < waited + 150.0);
      LessonRun judge(drive.lesson, drive.car, config.gate, {LessonMode::by_yourself, 0.0, HintStyle::summary});
      while (!judge.is_over()) judge.add(rig.step());
      // The limit allows for normal foot movement and tremor, but not for a jump between two laps.
      CHECK(rig.fastest_foot() < 0.06);
      CAPTURE(lap);
      CAPTURE(error_list(judge.result()));
      CAPTURE(judge.result().why);
      CHECK(judge.result().end == LessonEnd::done);
      CHECK_FALSE(rig.driver().is_over());
    }
  }
}

TEST_CASE("equal seeds give exactly equal drives; a gate without the lesson's gear is rejected") {
  const LessonDriveConfig drive = shipped_drive("moving_off");
  const AutoDriverConfig config = config_of(drive);
  Rig one(config, drive.lesson.start), other(config, drive.lesson.start);
  bool same = true;
  for (int i = 0; i < 10'000; ++i) {
    const DriveSample &a = one.step(), &b = other.step();
    same = same && a.lever.lever == b.lever.lever && a.car.road_speed == b.car.road_speed;
  }
  CHECK(same);
  AutoDriverConfig wrong = config_of(shipped_drive("up_through_the_gears"));
  wrong.gate = shipped_gate("four_speed");
  CHECK_THROWS_AS(AutoDriver{wrong}, std::invalid_argument);
}
