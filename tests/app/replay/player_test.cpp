// A recorded drive played: time, pace, ends, and that no sample is lost or shown twice.
#include "app/replay/player.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/app/replay/lesson_trace.h"

using namespace gearshift;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Frames of random length to the end: each sample once, in order, from the one that is shown first.
void check_passes_all(Player& player, std::mt19937& random) {
  std::uniform_real_distribution<double> frame(1e-4, 0.2);
  const DriveSample* next = &player.now();
  while (player.plays()) {
    CHECK(player.advance(frame(random)));
    CHECK_FALSE(player.jumped());
    for (const DriveSample& sample : player.passed()) CHECK(&sample == next++);
    CHECK(next == &player.now() + 1);
  }
  CHECK(player.time() == player.to());
  CHECK(next == &player.drive().at(player.to()) + 1);
}

}  // namespace

TEST_CASE("the drive's time goes on by the person's, times the pace; paused it stands") {
  Player player(upshifts().file);
  const double begin = player.drive().begin();
  CHECK(player.time() == begin);
  CHECK(player.from() == begin);
  CHECK(player.to() == player.drive().end());
  CHECK(player.plays());
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

TEST_CASE("it begins where it is asked to, and nowhere beyond the drive") {
  Player player(upshifts().file);
  const double begin = player.drive().begin(), length = player.drive().end() - begin;
  for (const double time : {0.0, length, 0.5 * length}) {
    player.begin_at(time);
    CHECK(player.time() == begin + time);
    CHECK(player.from() == begin);
    CHECK(player.plays());
  }
  for (const double beyond : {-0.001, length + 0.001, kNan})
    CHECK_THROWS_WITH_AS(player.begin_at(beyond), doctest::Contains("the drive lasts"), std::invalid_argument);
  CHECK(player.time() == begin + 0.5 * length);
}

TEST_CASE("pace and place are clamped to what there is") {
  Player player(upshifts().file);
  player.set_pace(1e9);
  CHECK(player.pace() == kFastest);
  player.set_pace(-3.0);
  CHECK(player.pace() == kSlowest);
  player.set_pace(kNan);
  CHECK(player.pace() == kSlowest);
  player.seek(1e9);
  CHECK(player.time() == player.to());
  player.seek(-1e9);
  CHECK(player.time() == player.from());
  player.seek(kNan);
  CHECK(player.time() == player.from());
}

TEST_CASE("at the end it stands; playing on begins anew") {
  Player player(upshifts().file);
  CHECK(player.advance(1e9));
  CHECK(player.time() == player.drive().end());
  CHECK(player.passed().size() == player.drive().samples().size());
  CHECK_FALSE(player.plays());
  CHECK_FALSE(player.advance(1.0));
  player.play(true);
  CHECK(player.time() == player.drive().begin());
  CHECK(player.jumped());
  CHECK(player.advance(0.1));
  CHECK(player.plays());
}

TEST_CASE("a shift is looked at with half a second on either side, and stops there") {
  Player player(upshifts().file);
  const auto& shifts = player.drive().shifts();
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    player.look_at(i);
    CHECK(*player.shift() == i);
    CHECK(player.time() == player.from());
    CHECK(player.from() == std::max(player.drive().begin(), shifts[i].record.begin - 0.5));
    CHECK(player.to() == std::min(player.drive().end(), shifts[i].record.end + 0.5));
    CHECK(player.plays());
    player.seek(player.drive().end());
    CHECK(player.time() == player.to());
    player.seek(player.from());
    CHECK(player.advance(1e9));
    CHECK(player.time() == player.to());
    CHECK_FALSE(player.plays());
    player.play(true);
    CHECK(player.time() == player.from());
  }
  const double stands = player.time();
  player.look_at(std::nullopt);
  CHECK_FALSE(player.shift());
  CHECK(player.time() == stands);
  CHECK(player.to() == player.drive().end());
  CHECK_THROWS_WITH_AS(player.look_at(99),
                       ("the drive has no shift 100: it has 1 to " + std::to_string(shifts.size())).c_str(),
                       std::invalid_argument);
  CHECK_FALSE(player.shift());
}

TEST_CASE("the shift nearest to a time is the one that begins nearest to it") {
  Player player(upshifts().file);
  const auto& shifts = player.drive().shifts();
  for (double time = -3.0; time < player.drive().end() + 3.0; time += 0.37) {
    player.look_near(time);
    const double away = std::abs(shifts[*player.shift()].record.begin - time);
    for (const RecordedShift& shift : shifts) CHECK(away <= std::abs(shift.record.begin - time));
  }
  player.look_near(shifts[2].record.begin);
  CHECK(*player.shift() == 2);
}

TEST_CASE("played forwards every sample passes exactly once, at any frame rate and pace, from anywhere") {
  Player player(upshifts().file);
  std::mt19937 random(5);
  for (const double pace : {1.0, 4.0, 0.35}) {
    player.look_at(std::nullopt);
    player.seek(player.from());
    player.play(true);
    player.set_pace(pace);
    check_passes_all(player, random);
  }
  for (std::size_t i = 0; i < player.drive().shifts().size(); ++i) {
    player.look_at(i);
    check_passes_all(player, random);
    player.seek(player.from() + 0.311);
    player.play(true);
    check_passes_all(player, random);
  }
}

TEST_CASE("a jump is told until the next step; what it jumped over does not pass") {
  Player player(upshifts().file);
  CHECK(player.jumped());
  player.advance(0.1);
  CHECK_FALSE(player.jumped());
  player.seek(player.from() + 2.0);
  CHECK(player.jumped());
  CHECK(player.passed().empty());
  player.advance(0.1);
  CHECK_FALSE(player.jumped());
  REQUIRE_FALSE(player.passed().empty());
  CHECK(&player.passed().front() == &player.drive().at(player.from() + 2.0));
  player.look_near(0.0);
  CHECK(player.jumped());
  player.play(false);
  player.advance(0.1);
  CHECK_FALSE(player.jumped());
}
