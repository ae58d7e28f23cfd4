// Styles and habits of simulated drivers, and their independence from the judge.
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/lesson_run.h"
#include "tests/app/lessons/simulated_driver/lessons.h"

using namespace gearshift;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

using Drive = std::vector<vehicle::DriveSample>;

// Drives the lesson, judged in `judged` and `car`, which may differ from the lesson and the car that are driven.
Drive drive_judged(const LessonDriveConfig& config, const Lesson& judged, const vehicle::CarSpec& car) {
  Drive drive;
  LessonRun run(judged, car, driven_gate(config.gate), {});
  drive_lesson(config, [&](const vehicle::DriveSample& sample) {
    run.add(sample);
    drive.push_back(sample);
    return LessonProgress{run.view().step, run.view().guided_gear, run.is_over()};
  });
  return drive;
}

std::size_t first_difference(const Drive& a, const Drive& b) {
  const auto same = [](const vehicle::DriveSample& x, const vehicle::DriveSample& y) {
    return x.controls.pedals.clutch == y.controls.pedals.clutch &&
           x.controls.pedals.throttle == y.controls.pedals.throttle &&
           x.controls.pedals.brake == y.controls.pedals.brake && x.lever.lever == y.lever.lever &&
           x.lever.f_h == y.lever.f_h && x.car.engine_speed == y.car.engine_speed &&
           x.car.road_speed == y.car.road_speed;
  };
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && same(a[i], b[i])) ++i;
  return i;
}

// A lesson of one shift down from fourth to third, without a word about revs.
LessonDriveConfig one_downshift() {
  LessonDriveConfig config = shipped_drive("rev_matching", 4);
  config.lesson.steps.resize(3);
  config.lesson.steps[2].until.engine_above.reset();
  return config;
}

const ShiftRecord& only_shift(const LessonResult& result) {
  REQUIRE(result.end == LessonEnd::done);
  REQUIRE(result.shifts.size() == 1);
  return result.shifts[0];
}

}  // namespace

TEST_CASE("a style is drawn from a seed with the stated spread, and the spread 0 changes nothing") {
  const DriverSkill skill = skill_of(0.3);
  CHECK(in_style(skill, 5) == in_style(skill, 5));
  CHECK_FALSE(in_style(skill, 5) == in_style(skill, 6));
  CHECK(in_style(skill, 5, {0, 0, 0, 0, 0, 0}) == skill);
  double sum = 0.0, squares = 0.0;
  constexpr int kDrivers = 4000;
  for (int i = 0; i < kDrivers; ++i) {
    const double x = std::log(in_style(skill, static_cast<std::uint64_t>(i)).pace / skill.pace);
    sum += x, squares += x * x;
  }
  CHECK(std::abs(sum / kDrivers) < 3.0 * 0.15 / std::sqrt(kDrivers));  // three standard errors of the mean
  CHECK(std::sqrt(squares / kDrivers) == doctest::Approx(0.15).epsilon(3.0 / std::sqrt(2.0 * kDrivers)));
}

TEST_CASE("the driver knows nothing of the judge's thresholds: a judge with others sees the same drive, bit for bit") {
  for (const std::string_view key : {"up_through_the_gears", "eco_driving", "hill_start", "rev_matching"}) {
    for (const ErrorKind error : {ErrorKind::stall, ErrorKind::early_shift, ErrorKind::late_shift, ErrorKind::jerk}) {
      LessonDriveConfig config = shipped_drive(key, 3);
      config.skill = in_style(skill_of(0.3), 3);
      config.errors = deliberate_error(error);
      const Drive drive = drive_judged(config, config.lesson, config.car);
      Lesson strict = config.lesson;
      strict.pass_grade = 10.0;
      strict.shift_from = 0.5 * strict.shift_from, strict.shift_to = 0.7 * strict.shift_to;
      strict.fails_on.assign({ErrorKind::wrong_column, ErrorKind::rev_mismatch});
      vehicle::CarSpec judged = config.car;
      judged.clutch.bite += 0.03;
      judged.engine.red_line *= 0.7, judged.engine.lug_below *= 1.5, judged.engine.stall *= 1.2;
      judged.engine.shift_low *= 1.3, judged.engine.shift_high *= 0.8;
      const Drive other = drive_judged(config, strict, judged);
      CAPTURE(key);
      CAPTURE(to_string(error));
      // A judge may end the run later, while it waits for the end of a shift.
      CHECK(first_difference(drive, other) == std::min(drive.size(), other.size()));
      CHECK(drive.size() > 3000);
      // Negative control: the check sees a hand that is 1 % faster.
      LessonDriveConfig faster = config;
      faster.skill.pace *= 1.01;
      CHECK(first_difference(drive, drive_judged(faster, config.lesson, config.car)) < drive.size());
    }
  }
}

TEST_CASE("a driver who blips matches the revs in a downshift that does not ask for it") {
  LessonDriveConfig config = one_downshift();
  const double plain = std::abs(only_shift(drive_lesson(config)).rev_error);
  config.skill.blips = true;
  const ShiftRecord blipped = only_shift(drive_lesson(config));
  CHECK(plain > 50.0);  // [rad/s] from idle to 2400 rpm
  CHECK(std::abs(blipped.rev_error) < 0.3 * plain);
  CHECK(blipped.steps_out_of_place == 0);
}

TEST_CASE("a driver who double-clutches lets the clutch up in neutral and matches the revs there") {
  LessonDriveConfig config = one_downshift();
  config.skill.double_clutches = true;
  const ShiftRecord shift = only_shift(drive_lesson(config));
  using enum ShiftStep;
  std::vector<ShiftStep> steps = shift.steps;
  std::erase_if(steps, [](ShiftStep step) { return step == throttle_off || step == throttle_on; });
  CHECK(steps == std::vector{clutch_down, neutral, clutch_up, clutch_down, gear, clutch_up});
  CHECK(std::abs(shift.rev_error) < 40.0);
}

TEST_CASE("a driver can hold a car on a slope with the clutch, without a brake") {
  LessonDriveConfig config = shipped_drive("hill_start", 2);
  LessonStep hold;
  hold.prompt = "Hold the car with the clutch.";
  hold.until.gear = 1;
  hold.until.clutch_torque_above = 15.0;  // [N m] half of what the car needs
  hold.until.hand_brake_below = 0.1, hold.until.brake_below = 0.05;
  hold.until.speed_above = -0.15, hold.until.speed_below = 0.15;  // [m/s]
  hold.until.held = 4.0;
  config.lesson.steps.insert(config.lesson.steps.end() - 1, hold);
  for (const double error : {0.0, 0.2}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      config.seed = seed;
      config.skill = in_style(skill_of(error), seed);
      const LessonResult result = drive_lesson(config);
      CAPTURE(seed);
      CAPTURE(result.why);
      CHECK(result.end == LessonEnd::done);
      CHECK_FALSE(names(result, ErrorKind::rollback));
    }
  }
}
