// Populations of simulated drivers, and the norms that they make.
#include "app/lessons/simulated_driver/population.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/suggest.h"
#include "app/lessons/simulated_driver/learning_experiment.h"
#include "tests/app/lessons/simulated_driver/lessons.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

constexpr std::uint64_t kTestSeed = 404;  // neither of the norms nor of the bench

std::vector<double> scores(const std::vector<LessonResult>& results) {
  std::vector<double> scores;
  for (const LessonResult& result : results)
    scores.push_back(result.end == LessonEnd::done ? -result.score.value() : -100.0);
  return scores;
}

long passes(const std::vector<LessonResult>& results) {
  return std::count_if(results.begin(), results.end(), [](const LessonResult& result) { return result.passed; });
}

}  // namespace

TEST_CASE("a population depends only on its seed, and its drivers differ") {
  const LessonDriveConfig drive = shipped_drive("rev_matching");
  const std::vector<LessonResult> a = drive_population(drive, {0.0, 5, kTestSeed}),
                                  b = drive_population(drive, {0.0, 5, kTestSeed});
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].figures.impulse == b[i].figures.impulse);
  CHECK(a[0].figures.impulse != a[1].figures.impulse);
  CHECK(drive_population(drive, {0.0, 1, kTestSeed + 1})[0].figures.impulse != a[0].figures.impulse);
}

TEST_CASE("the shipped norms are what `bench --norms` writes: byte for byte for one lesson") {
  const LessonDriveConfig drive = shipped_drive("start_and_stop");
  const Norm* shipped = norm_of(drive.lesson, LessonMode::by_yourself);
  REQUIRE(shipped != nullptr);
  const Norm derived = derive_norm(drive, LessonMode::by_yourself);
  CHECK(norms_text({&derived, 1}) == norms_text({shipped, 1}));
}

TEST_CASE("practised drivers pass each lesson by its norm and drivers with error 0.6 do not") {
  for (const std::string_view key : kTeachingOrder) {
    const LessonDriveConfig drive = shipped_drive(key);
    CAPTURE(key);
    REQUIRE(norm_of(drive.lesson, LessonMode::by_yourself) != nullptr);
    const std::vector<LessonResult> practised = drive_population(drive, {0.0, 6, kTestSeed}),
                                    novice = drive_population(drive, {0.6, 6, kTestSeed});
    CHECK(passes(practised) >= 5);
    CHECK(passes(novice) <= (key == "parking_in_gear" ? 3 : 2));  // its only shift tells little
    CHECK(roc_auc(scores(practised), scores(novice)) > 0.85);
  }
}

TEST_CASE("a run in another car or on another gate has no norm, and is judged by its errors only") {
  LessonDriveConfig drive = shipped_drive("up_through_the_gears");
  CHECK(drive_lesson(drive).grading == Grading::norm);
  LessonDriveConfig other = drive;
  other.car.name = "mine";
  const LessonResult result = drive_lesson(other);
  CHECK(result.grading == Grading::errors);
  CHECK_FALSE(result.score);
  CHECK(result.passed);
  other = drive;
  other.gate = gearshift::haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/dog_leg_five.toml");
  CHECK(drive_lesson(other).grading == Grading::errors);
}
