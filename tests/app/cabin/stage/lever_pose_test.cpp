#include "app/cabin/stage/lever_pose.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace gearshift::test {
namespace {

constexpr haptics::YokeGeometry kPaperYoke;

// The direction to the knob, computed without angles from the gate point and the sphere about the pivot.
glm::dvec3 knob_on_sphere(glm::dvec2 p, double radius) {
  return glm::dvec3(p.x, std::sqrt(radius * radius - p.x * p.x - p.y * p.y), -p.y) / radius;
}

}  // namespace

TEST_CASE("for any yoke, the lever points to the place on the sphere above the gate point") {
  std::mt19937_64 dice(11);
  std::uniform_real_distribution<double> x(-0.077, 0.077), y(-0.068, 0.068);
  for (const double radius : {0.120, 0.180}) {
    haptics::YokeGeometry yoke = kPaperYoke;
    yoke.radius = radius;
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec2 p(x(dice), y(dice));
      CHECK(glm::distance(cabin::lever_direction(yoke, p), knob_on_sphere(p, radius)) < 1e-12);
    }
  }
}

TEST_CASE("the lever leans right by a rotation about -Z and forward by one about -X") {
  const glm::dquat right = cabin::lever_rotation(kPaperYoke, {0.03, 0.0});
  CHECK(right.z < 0.0);
  CHECK(std::abs(right.x) + std::abs(right.y) < 1e-15);
  CHECK(2.0 * std::asin(-right.z) == doctest::Approx(std::asin(0.03 / 0.12)));
  const glm::dquat forward = cabin::lever_rotation(kPaperYoke, {0.0, 0.04});
  CHECK(forward.x < 0.0);
  CHECK(2.0 * std::asin(-forward.x) == doctest::Approx(std::asin(0.04 / 0.12)));
}

TEST_CASE("the rotation makes the upright lever lean without twisting the knob") {
  std::mt19937_64 dice(12);
  std::uniform_real_distribution<double> x(-0.077, 0.077), y(-0.068, 0.068);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 p(x(dice), y(dice));
    const glm::dquat turn = cabin::lever_rotation(kPaperYoke, p);
    CHECK(glm::distance(turn * glm::dvec3(0.0, 1.0, 0.0), knob_on_sphere(p, 0.12)) < 1e-12);
    CHECK(std::abs(turn.y) < 1e-15);  // the axis is perpendicular to the upright lever
  }
}

TEST_CASE("a gate point beyond the yoke's reach gives a horizontal lever, not NaN") {
  const glm::dvec3 d = cabin::lever_direction(kPaperYoke, {0.3, 0.4});
  CHECK(glm::length(d) == doctest::Approx(1.0));
  CHECK(d.y > 0.0);
  CHECK(d.x / -d.z == doctest::Approx(0.75));
}

}  // namespace gearshift::test
