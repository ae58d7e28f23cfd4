#include "app/session/cabin_camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/stage.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::session;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 ahead(const CabinCamera& look) {
  return look.pose().orientation * glm::dvec3(0.0, 0.0, -1.0);
}
double heading(const CabinCamera& look) {  // [deg] angle to the right of straight ahead (-Z)
  return std::atan2(ahead(look).x, -ahead(look).z) / kDegree;
}
double height(const CabinCamera& look) {  // [deg] angle above the horizon
  return std::asin(ahead(look).y) / kDegree;
}

}  // namespace

TEST_CASE("moving the mouse right or down looks right or down, by a fifth of a degree per pixel") {
  for (const char* place : {"driver", "ahead"}) {
    CAPTURE(place);
    CabinCamera look(place);
    const double heading_at_rest = heading(look), height_at_rest = height(look);
    look.turn({50.0, 0.0});
    CHECK(heading(look) == doctest::Approx(heading_at_rest + 10.0));
    CHECK(height(look) == doctest::Approx(height_at_rest));
    look.turn({-100.0, 0.0});
    CHECK(heading(look) == doctest::Approx(heading_at_rest - 10.0));
    look.recentre();
    look.turn({0.0, 50.0});
    CHECK(height(look) == doctest::Approx(height_at_rest - 10.0));
    CHECK(heading(look) == doctest::Approx(heading_at_rest));
    look.turn({0.0, -100.0});
    CHECK(height(look) == doctest::Approx(height_at_rest + 10.0));
    look.recentre();
    CHECK(height(look) == doctest::Approx(height_at_rest));
  }
}

TEST_CASE("the horizon stays level and the eye in place; the view turns at most 80 deg to the side and 60 deg up") {
  CabinCamera look("ahead");
  const glm::dvec3 eye = look.pose().position;
  const double heading_at_rest = heading(look), height_at_rest = height(look);
  for (const glm::dvec2 moved : {glm::dvec2(120.0, 70.0), {-300.0, -90.0}, {33.0, 250.0}, {1e4, -1e4}, {-1e5, 0.0}}) {
    look.turn(moved);
    CHECK(std::abs((look.pose().orientation * glm::dvec3(1.0, 0.0, 0.0)).y) < 1e-9);
    CHECK(look.pose().position == eye);
  }
  CHECK(heading(look) == doctest::Approx(heading_at_rest - 80.0));
  CHECK(height(look) == doctest::Approx(height_at_rest + 60.0));
}

TEST_CASE("the next camera begins straight ahead, and the first follows the last") {
  CabinCamera look("lever");
  std::string places;
  for (int i = 0; i < 6; ++i) {
    look.turn({200.0, 100.0});
    look.next();
    places += std::string(look.place()) + " ";
    const EyePose place = camera(look.place());
    CHECK(look.pose().position == place.position);
    CHECK(std::abs(glm::dot(look.pose().orientation, place.orientation)) == doctest::Approx(1.0));
    CHECK(look.field() == camera_field(look.place()));
  }
  CHECK(places == "gate cluster gearbox driver ahead lever ");
  CHECK_THROWS_AS(CabinCamera("roof"), std::invalid_argument);
}

TEST_CASE("watching a shift turns the driver's view to the lever and back; other views do not change") {
  CabinCamera look("driver");
  CHECK_FALSE(look.follow_shift(false));
  look.turn({50.0, 0.0});
  CHECK(look.follow_shift(true));
  CHECK(look.place() == "lever");
  CHECK(look.field() == camera_field("lever"));
  look.turn({50.0, 0.0});
  CHECK_FALSE(look.follow_shift(true));  // during the shift, the user's direction is kept
  CHECK(look.pose().orientation != camera("lever").orientation);
  CHECK(look.follow_shift(false));
  CHECK(look.place() == "driver");
  CHECK(look.follow_shift(true));
  look.next();  // during the shift, the user chooses a different camera
  const std::string chosen(look.place());
  CHECK_FALSE(look.follow_shift(false));
  CHECK(look.place() == chosen);
  CHECK_FALSE(look.follow_shift(true));
  CHECK(look.place() == chosen);
}
