// Playing a recorded drive: time, pace, and where playback starts and stops. Playing forwards returns every sample
// exactly once; samples skipped by a jump are not returned.
#include "app/lessons/replay/player.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/app/lessons/replay/lesson_trace.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Plays to the end in frames of random length. Checks that playback returns each sample once and in order, beginning
// with the sample that is shown now.
void check_passes_all(Player& player, std::mt19937& random) {
  std::uniform_real_distribution<double> frame(1e-4, 0.2);
  const DriveSample* next = &player.now();
  while (player.is_playing()) {
    CHECK(player.advance(frame(random)));
    CHECK_FALSE(player.has_jumped());
    for (const DriveSample& sample : player.passed()) CHECK(&sample == next++);
    CHECK(next == &player.now() + 1);
  }
  CHECK(player.time() == player.to());
  CHECK(next == &player.drive().at(player.to()) + 1);
}

}  // namespace

TEST_CASE("the replay's time advances by the elapsed time multiplied by the pace, and stops while paused") {
  Player player(upshifts().file);
  const double begin = player.drive().begin();
  CHECK(player.time() == begin);
  CHECK(player.from() == begin);
  CHECK(player.to() == player.drive().end());
  CHECK(player.is_playing());
  CHECK(player.advance(0.25));
  CHECK(player.time() == doctest::Approx(begin + 0.25).epsilon(1e-12));
  player.set_pace(0.5);
  CHECK(player.advance(1.0));
  CHECK(player.time() == doctest::Approx(begin + 0.75).epsilon(1e-12));
  CHECK(&player.now() == &player.drive().at(begin + 0.75));
  player.play(false);
  CHECK_FALSE(player.advance(1.0));
  CHECK(player.time() == doctest::Approx(begin + 0.75).epsilon(1e-12));
  CHECK(player.passed().empty());
  player.play(true);
  for (const double nothing : {0.0, -1.0, kNan}) CHECK_FALSE(player.advance(nothing));
  CHECK(player.advance(1.0));
  CHECK(player.time() == doctest::Approx(begin + 1.25).epsilon(1e-12));
}

TEST_CASE("a replay begins where requested, and never outside the drive") {
  Player player(upshifts().file);
  const double begin = player.drive().begin(), length = player.drive().end() - begin;
  for (const double time : {0.0, length, 0.5 * length}) {
    player.start_at(time);
    CHECK(player.time() == begin + time);
    CHECK(player.from() == begin);
    CHECK(player.is_playing());
  }
  for (const double beyond : {-0.001, length + 0.001, kNan})
    CHECK_THROWS_WITH_AS(player.start_at(beyond), doctest::Contains("is outside the drive"), std::invalid_argument);
  CHECK(player.time() == begin + 0.5 * length);
}

TEST_CASE("pace and position are clamped to their ranges") {
  Player player(upshifts().file);
  player.set_pace(1e9);
  CHECK(player.pace() == kMaxPace);
  player.set_pace(-3.0);
  CHECK(player.pace() == kMinPace);
  player.set_pace(kNan);
  CHECK(player.pace() == kMinPace);
  player.seek(1e9);
  CHECK(player.time() == player.to());
  player.seek(-1e9);
  CHECK(player.time() == player.from());
  player.seek(kNan);
  CHECK(player.time() == player.from());
}

TEST_CASE("the replay stops at its end; playing again starts from the beginning") {
  Player player(upshifts().file);
  CHECK(player.advance(1e9));
  CHECK(player.time() == player.drive().end());
  CHECK(player.passed().size() == player.drive().samples().size());
  CHECK_FALSE(player.is_playing());
  CHECK_FALSE(player.advance(1.0));
  player.play(true);
  CHECK(player.time() == player.drive().begin());
  CHECK(player.has_jumped());
  CHECK(player.advance(0.1));
  CHECK(player.is_playing());
}

TEST_CASE("a single shift is shown with half a second before and after it, and the replay stops there") {
  Player player(upshifts().file);
  const auto& shifts = player.drive().shifts();
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    player.select_shift(i);
    CHECK(*player.shift() == i);
    CHECK(player.time() == player.from());
    CHECK(player.from() == std::max(player.drive().begin(), shifts[i].record.begin - 0.5));
    CHECK(player.to() == std::min(player.drive().end(), shifts[i].record.end + 0.5));
    CHECK(player.is_playing());
    player.seek(player.drive().end());
    CHECK(player.time() == player.to());
    player.seek(player.from());
    CHECK(player.advance(1e9));
    CHECK(player.time() == player.to());
    CHECK_FALSE(player.is_playing());
    player.play(true);
    CHECK(player.time() == player.from());
  }
  const double before = player.time();
  player.select_shift(std::nullopt);
  CHECK_FALSE(player.shift());
  CHECK(player.time() == before);
  CHECK(player.to() == player.drive().end());
  CHECK_THROWS_WITH_AS(player.select_shift(99),
                       ("the drive has no shift 100; choose one from 1 to " + std::to_string(shifts.size())).c_str(),
                       std::invalid_argument);
  CHECK_FALSE(player.shift());
}

TEST_CASE("the shift nearest to a time is the one whose begin is nearest") {
  Player player(upshifts().file);
  const auto& shifts = player.drive().shifts();
  for (double time = -3.0; time < player.drive().end() + 3.0; time += 0.37) {
    player.select_nearest_shift(time);
    const double away = std::abs(shifts[*player.shift()].record.begin - time);
    for (const RecordedShift& shift : shifts) CHECK(away <= std::abs(shift.record.begin - time));
  }
  player.select_nearest_shift(shifts[2].record.begin);
  CHECK(*player.shift() == 2);
}

TEST_CASE("played forwards, every sample is passed exactly once, at any frame rate and pace, from any position") {
  Player player(upshifts().file);
  std::mt19937 random(5);
  for (const double pace : {1.0, 4.0, 0.35}) {
    player.select_shift(std::nullopt);
    player.seek(player.from());
    player.play(true);
    player.set_pace(pace);
    check_passes_all(player, random);
  }
  for (std::size_t i = 0; i < player.drive().shifts().size(); ++i) {
    player.select_shift(i);
    check_passes_all(player, random);
    player.seek(player.from() + 0.311);
    player.play(true);
    check_passes_all(player, random);
  }
}

TEST_CASE("a jump is reported until the next step, and the samples that it skipped are not passed") {
  Player player(upshifts().file);
  CHECK(player.has_jumped());
  player.advance(0.1);
  CHECK_FALSE(player.has_jumped());
  player.seek(player.from() + 2.0);
  CHECK(player.has_jumped());
  CHECK(player.passed().empty());
  player.advance(0.1);
  CHECK_FALSE(player.has_jumped());
  REQUIRE_FALSE(player.passed().empty());
  CHECK(&player.passed().front() == &player.drive().at(player.from() + 2.0));
  player.select_nearest_shift(0.0);
  CHECK(player.has_jumped());
  player.play(false);
  player.advance(0.1);
  CHECK_FALSE(player.has_jumped());
}
