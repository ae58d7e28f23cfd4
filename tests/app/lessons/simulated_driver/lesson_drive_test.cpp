// Lessons driven in simulated time. Repeating a lesson gives a bit-identical result. Lessons are also recorded,
// replayed, guided and abandoned.
#include <cmath>
#include <filesystem>

#include <doctest/doctest.h>

#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "tests/app/lessons/simulated_driver/lessons.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

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
  REQUIRE(a.shifts.size() == b.shifts.size());
  for (std::size_t i = 0; i < a.shifts.size(); ++i) {
    CHECK(a.shifts[i].impulse == b.shifts[i].impulse);
    CHECK(a.shifts[i].jerk_peak == b.shifts[i].jerk_peak);
    CHECK(a.shifts[i].steps == b.shifts[i].steps);
  }
  REQUIRE(a.errors.size() == b.errors.size());
  for (std::size_t i = 0; i < a.errors.size(); ++i) CHECK(error_sentence(a.errors[i]) == error_sentence(b.errors[i]));
}

}  // namespace

TEST_CASE("equal seeds give exactly equal drives, different seeds different drives") {
  const TempFolder folder;
  LessonDriveConfig config = shipped_drive("skip_shifts", 11);
  config.skill = skill_of(0.6);
  check_equal(drive_lesson(config), drive_lesson(config));
  const std::uint64_t hash = trace_hash(config, folder / "a.trace");
  CHECK(trace_hash(config, folder / "b.trace") == hash);
  config.seed = 12;
  CHECK(trace_hash(config, folder / "c.trace") != hash);
}

TEST_CASE("a lesson's trace replays bit for bit, guided and unguided, and recording does not affect the drive") {
  const TempFolder folder;
  for (const double guidance : {0.0, 0.7}) {
    CAPTURE(guidance);
    LessonDriveConfig config = shipped_drive("moving_off", 5);
    config.guidance = guidance;
    const LessonResult plain = drive_lesson(config);
    config.trace = folder / "lesson.trace";
    check_equal(drive_lesson(config), plain);
    const Trace trace = read_trace(config.trace);
    const ReplayResult again = replay(trace, make_car_load);
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

TEST_CASE("a guided drive has no grade; the same drive without guidance has a grade") {
  LessonDriveConfig config = shipped_drive("up_through_the_gears", 3);
  const LessonResult unguided = drive_lesson(config);
  config.guidance = 1.0;
  const LessonResult led = drive_lesson(config);
  CHECK(led.end == LessonEnd::done);
  CHECK(led.guided);
  CHECK(led.grade == 0.0);
  CHECK_FALSE(led.passed);
  CHECK_FALSE(unguided.guided);
  CHECK(unguided.passed);
}

TEST_CASE("guidance leads a beginner into fewer wrong slots, on a path that is no longer") {
  struct Path {
    int wrong = 0;
    double sum = 0.0, shifts = 0.0;
  };
  const auto drive = [](double guidance) {
    Path path;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      LessonDriveConfig config = shipped_drive("up_through_the_gears", seed);
      config.skill = skill_of(1.0);
      config.guidance = guidance;
      for (const ShiftRecord& shift : drive_lesson(config).shifts) {
        path.wrong += shift.wrong_columns;
        if (!shift.missed) path.sum += std::log(shift.path_efficiency), path.shifts += 1.0;
      }
    }
    return path;
  };
  const Path unguided = drive(0.0), guided = drive(1.0);
  CHECK(guided.wrong < unguided.wrong);
  CHECK(guided.sum / guided.shifts < unguided.sum / unguided.shifts + 0.02);
}

TEST_CASE("a simulated driver that is stuck leaves the lesson, and this is reported at once") {
  LessonDriveConfig config = shipped_drive("moving_off");
  config.lesson.steps[3].until.distance_above = 5000.0;  // [m] further than anybody drives in first gear
  config.lesson.time_limit = 600.0;
  const LessonResult result = drive_lesson(config);
  CHECK(result.end == LessonEnd::left);
  CHECK(result.duration < 120.0);
  CHECK_FALSE(result.passed);
}

TEST_CASE("a lesson for a gear that the gate lacks is rejected with a message") {
  LessonDriveConfig config = shipped_drive("up_through_the_gears");
  config.gate = read_gate_layout(GEARSHIFT_ASSETS "/gates/four_speed.toml");
  CHECK_THROWS_WITH_AS(drive_lesson(config),
                       "lesson up_through_the_gears needs gear 5, which this gate does not have; choose another gate",
                       std::invalid_argument);
}

// Loeb et al. 2015: in the same emergency, novices braked with half of the deceleration of experienced drivers.
TEST_CASE("in an emergency stop, a beginner brakes half as hard as a practised driver") {
  const auto hardest = [](double error) {
    const std::uint64_t seeds = is_full_campaign() ? 20 : 8;
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      LessonDriveConfig config = shipped_drive("emergency_stop", seed);
      config.skill = skill_of(error);
      double peak = 0.0;
      config.on_cycle = [&](const DriveSample& now) {
        if (now.car.road_speed > 1.0) peak = std::max(peak, now.car.pedals.brake);
      };
      drive_lesson(config);
      sum += peak / static_cast<double>(seeds);
    }
    return sum;
  };
  const double practised = hardest(0.0), beginner = hardest(1.0);
  CAPTURE(practised);
  CAPTURE(beginner);
  CHECK(practised > 0.9);
  CHECK(beginner / practised == doctest::Approx(0.5).epsilon(0.25));
}

// The idle control saves most of the engines that would have died without it (up to 0.1.0, more than half stalled).
TEST_CASE("some beginners stall when moving off, then use more throttle, and succeed in the end") {
  const std::uint64_t seeds = is_full_campaign() ? 20 : 8;
  std::uint64_t stalled = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    LessonDriveConfig config = shipped_drive("moving_off", seed);
    config.skill = skill_of(1.0);
    const LessonResult result = drive_lesson(config);
    CAPTURE(seed);
    CAPTURE(error_list(result));
    CHECK(result.end == LessonEnd::done);
    stalled += names(result, ErrorKind::stall) ? 1 : 0;
  }
  CHECK(stalled >= seeds / 8);
  CHECK(stalled < seeds);
}

TEST_CASE("a lesson can also be driven at other loop rates") {
  for (const double rate : {500.0, 2000.0}) {
    LessonDriveConfig config = shipped_drive("start_and_stop");
    config.rate = rate;
    const LessonResult result = drive_lesson(config);
    CAPTURE(rate);
    CAPTURE(error_list(result));
    CHECK(result.passed);
  }
}
