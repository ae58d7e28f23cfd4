// Where room and cabin stand to each other: laws of rigid motion, and a registration whose answer is known.
#include "app/headset/seat.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace gearshift;
using glm::dvec3;

namespace {

const glm::dquat kHeld(1.0, 0.0, 0.0, 0.0);

constexpr SeatPlaces kPlaces{{0.0, 0.635, 0.05}, {0.33, 0.127, -0.27}};
constexpr dvec3 kUp{0.0, 1.0, 0.0};

glm::dquat turned(double left, double up, double tilt = 0.0) {
  return glm::angleAxis(left, kUp) * glm::angleAxis(up, dvec3(1, 0, 0)) * glm::angleAxis(tilt, dvec3(0, 0, 1));
}

void check_at(dvec3 seen, dvec3 wanted, double within = 1e-12) {
  CAPTURE(seen.x);
  CAPTURE(seen.y);
  CAPTURE(seen.z);
  CHECK(glm::distance(seen, wanted) < within);
}

void check_level(const EyePose& seat) {
  check_at(seat.orientation * kUp, kUp);  // gravity is the same
}

}  // namespace

TEST_CASE("who sits down is at the driver's eyes and looks ahead, wherever he looks up, down or aside of level") {
  for (const double left : {0.0, 0.7, -2.9, 3.1}) {
    for (const double up : {0.0, -0.6, 0.5, -1.5, 1.5}) {  // to his feet, to the roof
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

TEST_CASE("with the knob measured it is seen where it is, and the eyes are as far from it as they are") {
  const EyePose head{{-0.4, 1.2, 0.9}, turned(1.1, -0.2)};
  const KnobDistance knob{0.28, 0.46, 0.31};
  const EyePose seat = seat_at_lever(head, kPlaces, knob);
  check_level(seat);
  // In the room, from the head's heading and by hand: ahead is (-sin 1.1, 0, -cos 1.1), right is (cos 1.1, 0, -sin 1.1).
  const dvec3 ahead(-std::sin(1.1), 0.0, -std::cos(1.1)), right(std::cos(1.1), 0.0, -std::sin(1.1));
  check_at(seat * (head.position + 0.28 * right - 0.46 * kUp + 0.31 * ahead), kPlaces.knob);
  check_at(seat * head.position, kPlaces.knob + dvec3(-0.28, 0.46, 0.31));
}

TEST_CASE("a driver has the lever towards the car's middle: to his right on the left, to his left on the right") {
  CHECK_NOTHROW(check_knob({0.3, 0.5, 0.3}, DriveSide::left));
  CHECK_NOTHROW(check_knob({-0.3, 0.5, 0.3}, DriveSide::right));
  CHECK_THROWS_WITH(check_knob({0.3, 0.5, 0.3}, DriveSide::right),
                    "a driver on the right has the knob to his left: 0.3 m to the right cannot be");
  CHECK_THROWS_WITH(check_knob({-0.3, 0.5, 0.3}, DriveSide::left),
                    "a driver on the left has the knob to his right: -0.3 m to the right cannot be");
}

TEST_CASE("touches in six gears find turn and shift of any room, exactly where they are exact") {
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

TEST_CASE("trembling touches are least squares: no other turn or shift near by has less, and the worst is told") {
  std::mt19937_64 dice(11);
  std::normal_distribution<double> tremble(0.0, 0.002);
  LeverTouches touches;
  std::vector<std::pair<dvec3, dvec3>> pairs;
  const EyePose room_from_cabin{{0.5, 0.9, -1.0}, glm::angleAxis(0.8, kUp)};
  for (int i = 0; i < 12; ++i) {
    const dvec3 knob = kPlaces.knob + dvec3(0.036 * (i % 3 - 1), 0.0, i % 2 == 0 ? 0.04 : -0.04);
    const dvec3 told = room_from_cabin * knob + dvec3(tremble(dice), tremble(dice), tremble(dice));
    touches.add({told, kHeld}, knob);
    pairs.push_back({told, knob});
  }
  const auto fit = touches.fit({});
  REQUIRE(fit);
  const auto squares = [&](const EyePose& seat) {
    double sum = 0.0;
    for (const auto& [room, knob] : pairs) sum += glm::dot(seat * room - knob, seat * room - knob);
    return sum;
  };
  const double least = squares(fit->cabin_from_room);
  dvec3 middle(0.0);
  for (const auto& [room, knob] : pairs) middle += room / 12.0;
  for (const double turn : {-0.01, 0.01}) {  // about the touches' middle
    EyePose other = fit->cabin_from_room;
    other.orientation = glm::angleAxis(turn, kUp) * other.orientation;
    other.position += fit->cabin_from_room * middle - other * middle;
    CHECK(squares(other) > least);
  }
  for (const dvec3 shift : {dvec3(1e-3, 0, 0), dvec3(0, 1e-3, 0), dvec3(0, 0, -1e-3)}) {
    EyePose other = fit->cabin_from_room;
    other.position += shift;
    CHECK(squares(other) > least);
  }
  CHECK(fit->worst > 0.001);
  CHECK(fit->worst < 0.010);
  CHECK(std::abs(2.0 * std::atan2(fit->cabin_from_room.orientation.y, fit->cabin_from_room.orientation.w) + 0.8) <
        0.05);
}

// About one axis by a, about another by b: cos(c/2) = cos(a/2) cos(b/2) between the two.
TEST_CASE("how far the controller was turned is the most between any two touches") {
  LeverTouches touches;
  CHECK(touches.turned() == 0.0);
  touches.add({{}, glm::angleAxis(0.3, kUp)}, kPlaces.knob);
  CHECK(touches.turned() == doctest::Approx(0.0));
  touches.add({{}, -glm::angleAxis(0.9, kUp)}, kPlaces.knob);  // the same turn, told with the other sign
  CHECK(touches.turned() == doctest::Approx(0.6));
  touches.add({{}, glm::angleAxis(0.3, kUp) * glm::angleAxis(0.8, dvec3(1, 0, 0))}, kPlaces.knob);
  CHECK(touches.turned() == doctest::Approx(2.0 * std::acos(std::cos(0.3) * std::cos(0.4))));
}

// What the comment of kLeastTurn says (seating.cpp): a third of a tip's error is seen.
TEST_CASE(
    "a tip that is told beside shows in the misfit by a third and more where the controller was turned by 45 degrees") {
  for (const dvec3 tip : {dvec3(0.03, 0, 0), dvec3(0, 0, 0.03)}) {
    LeverTouches still, turned;
    const dvec3 gears[] = {{0.0, 0.0, 0.0}, {-0.036, 0.0, -0.04}, {0.036, 0.0, 0.04}};
    for (int i = 0; i < 3; ++i) {
      const dvec3 knob = kPlaces.knob + gears[i];
      still.add({knob + tip, kHeld}, knob);
      const glm::dquat held = glm::angleAxis(0.3927 * (i - 1), kUp);
      turned.add({knob + held * tip, held}, knob);
    }
    CHECK(still.fit({})->worst < 1e-12);  // and not at all where it was not
    const double share = turned.fit({})->worst / 0.03;
    MESSAGE("a share of " << share << " is seen");
    CHECK(share > 1.0 / 3.0);
  }
}

TEST_CASE("one touch shifts and leaves the direction") {
  LeverTouches touches;
  CHECK_FALSE(touches.fit({}));
  const EyePose now{{0.1, 0.2, 0.3}, glm::angleAxis(-0.4, kUp)};
  touches.add({{2.0, 1.0, 0.5}, kHeld}, kPlaces.knob);
  touches.add({{2.0, 1.0, 0.508}, kHeld},
              kPlaces.knob + dvec3(0.008, 0, 0));  // as far apart as a hand trembles: no direction
  const auto fit = touches.fit(now);
  REQUIRE(fit);
  CHECK_FALSE(fit->turned);
  CHECK(glm::distance(fit->cabin_from_room.orientation * dvec3(0, 0, -1), now.orientation * dvec3(0, 0, -1)) < 1e-12);
  check_at(0.5 * (fit->cabin_from_room * dvec3(2.0, 1.0, 0.5) + fit->cabin_from_room * dvec3(2.0, 1.0, 0.508)),
           kPlaces.knob + dvec3(0.004, 0, 0));
  touches.forget();
  CHECK(touches.count() == 0);
}
