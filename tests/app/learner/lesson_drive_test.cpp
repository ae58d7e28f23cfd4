// A lesson on the virtual clock: the same to the bit, recorded and replayed, guided and left.
#include <filesystem>

#include <doctest/doctest.h>

#include "app/training/lesson_world.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "tests/app/learner/lessons.h"
#include "tests/support/temp_folder.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift;

namespace {

std::uint64_t trace_hash(LessonDriveConfig config, const std::filesystem::path& file) {
  config.trace = file;
  drive_lesson(config);
  return read_trace(file).hash;
}

void check_equal(const LessonResult& a, const LessonResult& b) {
  CHECK(a.duration == b.duration);
  CHECK(a.grade == b.grade);
  CHECK(a.slip_energy == b.slip_energy);
  CHECK(a.fuel == b.fuel);
  REQUIRE(a.shifts.size() == b.shifts.size());
  for (std::size_t i = 0; i < a.shifts.size(); ++i) {
    CHECK(a.shifts[i].impulse == b.shifts[i].impulse);
    CHECK(a.shifts[i].jerk_peak == b.shifts[i].jerk_peak);
    CHECK(a.shifts[i].steps == b.shifts[i].steps);
  }
  REQUIRE(a.faults.size() == b.faults.size());
  for (std::size_t i = 0; i < a.faults.size(); ++i) CHECK(a.faults[i].value == b.faults[i].value);
}

}  // namespace

TEST_CASE("the same seed drives the same lesson to the bit, another seed another one") {
  const TempFolder folder;
  LessonDriveConfig config = shipped_drive("skip_shifts", 11);
  config.skill = skill_of(0.6);
  check_equal(drive_lesson(config), drive_lesson(config));
  const std::uint64_t hash = trace_hash(config, folder / "a.trace");
  CHECK(trace_hash(config, folder / "b.trace") == hash);
  config.seed = 12;
  CHECK(trace_hash(config, folder / "c.trace") != hash);
}

TEST_CASE("a lesson's trace replays bit for bit, guided and unguided, and recording changes nothing") {
  const TempFolder folder;
  for (const double guidance : {0.0, 0.7}) {
    CAPTURE(guidance);
    LessonDriveConfig config = shipped_drive("moving_off", 5);
    config.guidance = guidance;
    const LessonResult plain = drive_lesson(config);
    config.trace = folder / "lesson.trace";
    check_equal(drive_lesson(config), plain);
    const Trace trace = read_trace(config.trace);
    const ReplayResult again = replay(trace, make_lesson_world);
    CHECK(again.bit_for_bit());
    CHECK(again.seconds == doctest::Approx(plain.duration).epsilon(0.001));
    CHECK(again.cycles > 5000);
  }
  CHECK_THROWS_AS(drive_lesson([&] {
                    LessonDriveConfig config = shipped_drive("moving_off");
                    config.trace = folder / "nowhere" / "lesson.trace";
                    return config;
                  }()),
                  FileError);
}

TEST_CASE("a guided drive has no grade, the same drive alone has one") {
  LessonDriveConfig config = shipped_drive("up_through_the_gears", 3);
  const LessonResult alone = drive_lesson(config);
  config.guidance = 1.0;
  const LessonResult led = drive_lesson(config);
  CHECK(led.end == LessonEnd::done);
  CHECK(led.guided);
  CHECK(led.grade == 0.0);
  CHECK_FALSE(led.passed);
  CHECK_FALSE(alone.guided);
  CHECK(alone.passed);
}

TEST_CASE("the guidance shortens a beginner's way through the gate") {
  const auto detour = [](double guidance) {
    double sum = 0.0, shifts = 0.0;
    for (std::uint64_t seed = 1; seed <= (is_whole_campaign() ? 10u : 4u); ++seed) {
      LessonDriveConfig config = shipped_drive("up_through_the_gears", seed);
      config.skill = skill_of(1.0);
      config.guidance = guidance;
      for (const ShiftRecord& shift : drive_lesson(config).shifts) sum += shift.path_efficiency, shifts += 1.0;
    }
    return sum / shifts;
  };
  const double alone = detour(0.0), led = detour(1.0);
  CAPTURE(alone);
  CAPTURE(led);
  CHECK(led < 0.98 * alone);
}

TEST_CASE("a learner who gets no further leaves the lesson: it is told, not waited for") {
  LessonDriveConfig config = shipped_drive("moving_off");
  config.lesson.steps[3].until.speed_above = 60.0;  // 216 km/h in first
  config.lesson.time_limit = 600.0;
  const LessonResult result = drive_lesson(config);
  CHECK(result.end == LessonEnd::left);
  CHECK(result.duration < 120.0);
  CHECK_FALSE(result.passed);
}

TEST_CASE("a lesson whose gear the gate lacks is refused in words") {
  LessonDriveConfig config = shipped_drive("up_through_the_gears");
  config.gate = read_gate_layout(GEARSHIFT_ASSETS "/gates/four_speed.toml");
  CHECK_THROWS_WITH_AS(drive_lesson(config), "lesson up_through_the_gears needs gear 5, which this gate lacks",
                       std::invalid_argument);
}

// Loeb and others 2015: in the same emergency novices decelerated half as much as experienced drivers.
TEST_CASE("called to stop, a beginner brakes half as hard as a practised one") {
  const auto hardest = [](double error) {
    const std::uint64_t seeds = is_whole_campaign() ? 20 : 8;
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      LessonDriveConfig config = shipped_drive("emergency_stop", seed);
      config.skill = skill_of(error);
      double most = 0.0;
      config.watch = [&](const DriveSample& now) {
        if (now.car.road_speed > 1.0) most = std::max(most, now.car.brake);
      };
      drive_lesson(config);
      sum += most / static_cast<double>(seeds);
    }
    return sum;
  };
  const double practised = hardest(0.0), beginner = hardest(1.0);
  CAPTURE(practised);
  CAPTURE(beginner);
  CHECK(practised > 0.9);
  CHECK(beginner / practised == doctest::Approx(0.5).epsilon(0.25));
}

TEST_CASE("beginners stall as they move off, give more gas then, and get away in the end") {
  const std::uint64_t seeds = is_whole_campaign() ? 20 : 8;
  std::uint64_t stalled = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    LessonDriveConfig config = shipped_drive("moving_off", seed);
    config.skill = skill_of(1.0);
    const LessonResult result = drive_lesson(config);
    CAPTURE(seed);
    CAPTURE(fault_list(result));
    CHECK(result.end == LessonEnd::done);
    stalled += names(result, FaultKind::stall) ? 1 : 0;
  }
  CHECK(stalled > seeds / 2);
}

TEST_CASE("it drives at other rates of the loop too") {
  for (const double rate : {500.0, 2000.0}) {
    LessonDriveConfig config = shipped_drive("start_and_stop");
    config.rate = rate;
    const LessonResult result = drive_lesson(config);
    CAPTURE(rate);
    CAPTURE(fault_list(result));
    CHECK(result.passed);
  }
}
