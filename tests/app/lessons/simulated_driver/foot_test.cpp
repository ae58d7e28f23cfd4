// The simulated driver's foot and hand, each tested separately.
#include "app/lessons/simulated_driver/foot.h"

#include <cmath>

#include <doctest/doctest.h>

#include "app/lessons/simulated_driver/driver_skill.h"
#include "app/lessons/simulated_driver/stroke_hand.h"

using namespace gearshift::lessons;

TEST_CASE("a foot reaches its goal in the time given by its rate, and stays within the pedal's travel") {
  Foot foot(0.0, 1);
  foot.move_to(1.0, 5.0);
  int cycles = 0;
  while (foot.step(0.001) < 1.0) ++cycles;
  CHECK(cycles == doctest::Approx(200).epsilon(0.01));
  foot.move_to(7.0, 5.0);
  CHECK(foot.step(0.1) == 1.0);
  foot.move_to(-3.0, 50.0);
  CHECK(foot.step(0.1) == 0.0);
}

TEST_CASE("the tremor of a held pedal has the configured spread at any cycle rate, and is zero at the pedal's rest") {
  for (const double dt : {0.0005, 0.001, 0.004}) {
    Foot foot(0.02, 42);
    foot.place(0.5);
    double sum = 0.0, squares = 0.0;
    const int n = static_cast<int>(400.0 / dt);
    for (int i = 0; i < n; ++i) {
      const double off = foot.step(dt) - 0.5;
      sum += off, squares += off * off;
    }
    CAPTURE(dt);
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.02).epsilon(0.06));
    CHECK(std::abs(sum / n) < 0.003);
    foot.place(0.0);
    CHECK(foot.step(dt) == 0.0);
    foot.place(1.0);
    CHECK(foot.step(dt) == 1.0);
  }
}

TEST_CASE("a hand waits at a blocked lever, pushes harder up to its maximum, and reduces its push gradually") {
  StrokeHand hand(0.001);
  const glm::dvec2 lever{0.0, 0.01};
  CHECK(hand.next(0.0, lever).position == lever);
  CHECK(hand.next(0.0, lever).push == glm::dvec2(0.0));
  hand.start({{{0.0, 0.0}, 0.2, 0.0, {}, false, false}, {{0.03, 0.0}, 0.2, 0.0, {}, false, false}}, lever, 0.0);
  double push = 0.0, before = 0.0;
  for (int i = 0; i < 2000; ++i) {
    push = hand.next(0.001 * i, lever).push.y;  // the lever stays blocked
    CHECK(push <= before + 1e-12);
    before = push;
  }
  CHECK(push == doctest::Approx(-25.0));  // [N] the grip's spring adds 500 N/m times 10 mm
  CHECK_FALSE(hand.in_last_stroke());
  CHECK(hand.time_waiting(1.2) == doctest::Approx(1.0));
  hand.next(2.0, {0.0, 0.001});  // the lever has now reached the end of the first stroke
  CHECK(hand.in_last_stroke());
}

TEST_CASE("skill is interpolated between practised and beginner, and every part of it gets worse with the error") {
  CHECK(skill_of(0.0) == DriverSkill{});
  CHECK(skill_of(-1.0) == skill_of(0.0));
  CHECK(skill_of(2.0) == skill_of(1.0));
  for (double e = 0.0; e < 0.95; e += 0.1) {
    const DriverSkill good = skill_of(e), worse = skill_of(e + 0.1);
    CHECK(worse.reaction > good.reaction);
    CHECK(worse.timing_spread > good.timing_spread);
    CHECK(worse.aim_noise > good.aim_noise);
    CHECK(worse.pedal_noise > good.pedal_noise);
    CHECK(worse.rev_spread > good.rev_spread);
    CHECK(worse.release_spread > good.release_spread);
    CHECK(worse.release_haste > good.release_haste);
    CHECK(worse.hearing_delay > good.hearing_delay);
    CHECK(worse.foot_change > good.foot_change);
    CHECK(worse.max_bite_drop > good.max_bite_drop);
    CHECK(worse.pace < good.pace);
    CHECK(worse.brake_effort < good.brake_effort);
    CHECK(worse.launch_speed_factor < good.launch_speed_factor);
  }
}
