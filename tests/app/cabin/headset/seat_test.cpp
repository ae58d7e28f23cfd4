// The transform between room and cabin is a rigid motion. A fit to touched points finds the known transform.
#include "app/cabin/headset/seat.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace gearshift::cabin;
using namespace gearshift::engine;
using glm::dvec3;

namespace {

const glm::dquat kHeld(1.0, 0.0, 0.0, 0.0);

constexpr SeatPlaces kPlaces{{0.0, 0.635, 0.05}, {0.33, 0.127, -0.27}};
constexpr dvec3 kUp{0.0, 1.0, 0.0};

glm::dquat turned(double left, double up, double tilt = 0.0) {
  return glm::angleAxis(left, kUp) * glm::angleAxis(up, dvec3(1, 0, 0)) * glm::angleAxis(tilt, dvec3(0, 0, 1));
}

void check_at(dvec3 actual, dvec3 expected, double within = 1e-12) {
  CAPTURE(actual.x);
  CAPTURE(actual.y);
  CAPTURE(actual.z);
  CHECK(glm::distance(actual, expected) < within);
}

void check_level(const EyePose& seat) {
  check_at(seat.orientation * kUp, kUp);  // up stays up
}

}  // namespace

TEST_CASE("the user's head is placed at the driver's eyes, facing ahead, even when looking up, down or aside") {
  for (const double left : {0.0, 0.7, -2.9, 3.1}) {
    // [rad] pitch of the gaze; +-1.5 is almost straight up or down.
    for (const double up : {0.0, -0.6, 0.5, -1.5, 1.5}) {
      const EyePose head{{1.3, 1.6, -2.2}, turned(left, up, 0.0)};
      const EyePose seat = seat_at_eyes(head, kPlaces, 0.04);
      CAPTURE(left);
      CAPTURE(up);
      check_level(seat);
      check_at(seat * head.position, kPlaces.eye + 0.04 * kUp);
      check_at(seat.orientation * (glm::angleAxis(left, kUp) * dvec3(0, 0, -1)), {0, 0, -1}, 1e-9);
    }
  }
}

TEST_CASE("a knob with measured distances is drawn at its true place, at its true distance from the eyes") {
  const EyePose head{{-0.4, 1.2, 0.9}, turned(1.1, -0.2)};
  const KnobDistance knob{0.28, 0.46, 0.31};
  const EyePose seat = seat_at_lever(head, kPlaces, knob);
  check_level(seat);
  // Directions in the room, computed by hand from the head's heading of 1.1 rad.
  const dvec3 ahead(-std::sin(1.1), 0.0, -std::cos(1.1)), right(std::cos(1.1), 0.0, -std::sin(1.1));
  check_at(seat * (head.position + 0.28 * right - 0.46 * kUp + 0.31 * ahead), kPlaces.knob);
  check_at(seat * head.position, kPlaces.knob + dvec3(-0.28, 0.46, 0.31));
}

TEST_CASE("the lever is on the car's centre side: right of a driver on the left, left of a driver on the right") {
  CHECK_NOTHROW(check_knob({0.3, 0.5, 0.3}, DriveSide::left));
  CHECK_NOTHROW(check_knob({-0.3, 0.5, 0.3}, DriveSide::right));
  CHECK_THROWS_WITH(
      check_knob({0.3, 0.5, 0.3}, DriveSide::right),
      "when the driver sits on the right, the knob must be on the left; 0.3 m to the right is on the wrong side");
  CHECK_THROWS_WITH(
      check_knob({-0.3, 0.5, 0.3}, DriveSide::left),
      "when the driver sits on the left, the knob must be on the right; -0.3 m to the right is on the wrong side");
}

TEST_CASE("touches in six gears give any room's rotation and shift, exactly if the touches are exact") {
  std::mt19937_64 dice(7);
  std::uniform_real_distribution<double> anywhere(-3.0, 3.0);
  for (int i = 0; i < 50; ++i) {
    const EyePose room_from_cabin{{anywhere(dice), anywhere(dice), anywhere(dice)},
                                  glm::angleAxis(anywhere(dice), kUp)};
    LeverTouches touches;
    for (const double select : {-0.036, 0.0, 0.036})
      for (const double shift : {-0.04, 0.04}) {
        const dvec3 knob = kPlaces.knob + dvec3(select, -0.003, -shift);
        touches.add({room_from_cabin * knob, kHeld}, knob);
      }
    const auto fit = touches.fit({});
    REQUIRE(fit);
    CHECK(fit->turned);
    CHECK(fit->worst < 1e-12);
    check_level(fit->cabin_from_room);
    const EyePose known = inverse(room_from_cabin);
    for (const dvec3 point : {dvec3(0, 0, 0), dvec3(1, 2, 3)})
      check_at(fit->cabin_from_room * point, known * point, 1e-11);
  }
}

TEST_CASE("noisy touches are fitted by least squares: no nearby fit is better, and the worst error is reported") {
  std::mt19937_64 dice(11);
  std::normal_distribution<double> tremble(0.0, 0.002);
  LeverTouches touches;
  std::vector<std::pair<dvec3, dvec3>> pairs;
  const EyePose room_from_cabin{{0.5, 0.9, -1.0}, glm::angleAxis(0.8, kUp)};
  for (int i = 0; i < 12; ++i) {
    const dvec3 knob = kPlaces.knob + dvec3(0.036 * (i % 3 - 1), 0.0, i % 2 == 0 ? 0.04 : -0.04);
    const dvec3 touched = room_from_cabin * knob + dvec3(tremble(dice), tremble(dice), tremble(dice));
    touches.add({touched, kHeld}, knob);
    pairs.push_back({touched, knob});
  }
  const auto fit = touches.fit({});
  REQUIRE(fit);
  const auto squares = [&](const EyePose& seat) {
    double sum = 0.0;
    for (const auto& [room, knob] : pairs) sum += glm::dot(seat * room - knob, seat * room - knob);
    return sum;
  };
  const double smallest = squares(fit->cabin_from_room);
  dvec3 middle(0.0);
  for (const auto& [room, knob] : pairs) middle += room / 12.0;
  // [rad] error of the room's rotation about the centre of the touched points.
  for (const double turn : {-0.01, 0.01}) {
    EyePose other = fit->cabin_from_room;
    other.orientation = glm::angleAxis(turn, kUp) * other.orientation;
    other.position += fit->cabin_from_room * middle - other * middle;
    CHECK(squares(other) > smallest);
  }
  for (const dvec3 shift : {dvec3(1e-3, 0, 0), dvec3(0, 1e-3, 0), dvec3(0, 0, -1e-3)}) {
    EyePose other = fit->cabin_from_room;
    other.position += shift;
    CHECK(squares(other) > smallest);
  }
  CHECK(fit->worst > 0.001);
  CHECK(fit->worst < 0.010);
  CHECK(std::abs(2.0 * std::atan2(fit->cabin_from_room.orientation.y, fit->cabin_from_room.orientation.w) + 0.8) <
        0.05);
}

// Measures the reported fraction independently: shifts the controller's tip by 0.1 mm in many directions, repeats the
// fit, and divides the misfit by 0.1 mm. The smallest quotient must be close to the reported fraction, and not below
// it.
TEST_CASE("the reported tip error fraction is a lower bound, and zero if the tip was turned about one axis only") {
  std::mt19937_64 dice(5);
  std::normal_distribution<double> any;
  const glm::dvec3 gears[] = {{0.0, 0.0, 0.0}, {-0.036, -0.003, -0.04}, {0.036, -0.003, 0.04}, {0.0, -0.002, 0.04}};
  const dvec3 side(1, 0, 0);
  const std::vector<std::vector<glm::dquat>> holds = {
      {kHeld, glm::angleAxis(0.785, kUp), glm::angleAxis(0.785, side)},
      {glm::angleAxis(-1.0, side), glm::angleAxis(0.8, kUp), glm::angleAxis(-0.8, kUp), glm::angleAxis(0.4, side)},
      {kHeld, -glm::angleAxis(1.6, kUp), glm::angleAxis(0.8, kUp) * glm::angleAxis(0.8, side)}};
  for (const std::vector<glm::dquat>& held : holds) {
    LeverTouches exact;
    for (std::size_t i = 0; i < held.size(); ++i) exact.add({gears[i], held[i]}, kPlaces.knob + gears[i]);
    const double fraction = exact.tip_error_fraction();
    double smallest = 1.0;
    for (int k = 0; k < 3000; ++k) {
      const dvec3 tip = 1e-4 * glm::normalize(dvec3(any(dice), any(dice), any(dice)));
      LeverTouches shifted;
      for (std::size_t i = 0; i < held.size(); ++i)
        shifted.add({gears[i] + held[i] * tip, held[i]}, kPlaces.knob + gears[i]);
      const EyePose found = shifted.fit({})->cabin_from_room;
      double squares = 0.0;
      for (std::size_t i = 0; i < held.size(); ++i) {
        const dvec3 left = found * (gears[i] + held[i] * tip) - (kPlaces.knob + gears[i]);
        squares += glm::dot(left, left) / static_cast<double>(held.size());
      }
      smallest = std::min(smallest, std::sqrt(squares) / 1e-4);
    }
    MESSAGE("a fraction of " << fraction << "; the minimum over 3000 tips " << smallest);
    CHECK(fraction > 0.15);
    CHECK(smallest >= 0.99 * fraction);
    CHECK(smallest <= 1.1 * fraction);
  }
  for (const dvec3 axis : {kUp, side, dvec3(0, 0, 1)}) {
    LeverTouches turned;
    for (int i = 0; i < 3; ++i) turned.add({gears[i], glm::angleAxis(0.7 * i, axis)}, kPlaces.knob + gears[i]);
    CHECK(turned.tip_error_fraction() < 1e-6);
  }
  CHECK(LeverTouches().tip_error_fraction() == 0.0);
}

TEST_CASE("a single touched point shifts the room and keeps its direction") {
  LeverTouches touches;
  CHECK_FALSE(touches.fit({}));
  const EyePose now{{0.1, 0.2, 0.3}, glm::angleAxis(-0.4, kUp)};
  touches.add({{2.0, 1.0, 0.5}, kHeld}, kPlaces.knob);
  touches.add({{2.0, 1.0, 0.508}, kHeld},
              kPlaces.knob + dvec3(0.008, 0, 0));  // only 8 mm from the first touch: too close to give a direction
  const auto fit = touches.fit(now);
  REQUIRE(fit);
  CHECK_FALSE(fit->turned);
  CHECK(glm::distance(fit->cabin_from_room.orientation * dvec3(0, 0, -1), now.orientation * dvec3(0, 0, -1)) < 1e-12);
  check_at(0.5 * (fit->cabin_from_room * dvec3(2.0, 1.0, 0.5) + fit->cabin_from_room * dvec3(2.0, 1.0, 0.508)),
           kPlaces.knob + dvec3(0.004, 0, 0));
  touches.forget();
  CHECK(touches.count() == 0);
}
