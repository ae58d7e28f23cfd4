// Tests the light in rooms for which the solution is known.
#include "engine/light/enclosure.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

using namespace gearshift::engine;
using glm::vec3;

namespace {

const vec3 kSun = glm::normalize(vec3(0.35f, 0.80f, -0.48f));
const vec3 kDark(0.0f);

vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

Radiance constant(vec3 radiance) {
  return [=](vec3) { return radiance; };
}

// A spherical room of radius 1. The window is a cap around +Z with height 2 f, which covers a fraction f of all
// directions.
Enclosure cap(float fraction, vec3 albedo) {
  return {[=](vec3 d) { return d.z > 1.0f - 2.0f * fraction; }, [=](vec3) { return albedo; }};
}

// Fraction of directions that satisfy a predicate, sampled on a Fibonacci sphere.
template <typename Predicate>
double fraction_of_directions(Predicate predicate, int count = 100000) {
  int count_true = 0;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, phi = i * 2.39996322973, r = std::sqrt(1.0 - z * z);
    count_true += predicate(vec3(r * std::cos(phi), r * std::sin(phi), z)) ? 1 : 0;
  }
  return static_cast<double>(count_true) / count;
}

}  // namespace

TEST_CASE("a room without windows is dark under any sky and sun") {
  const Enclosure room{[](vec3) { return false; }, [](vec3) { return vec3(0.9f); }};
  const Radiance light = indoor_radiance(room, day_sky(kSun), kSun, vec3(3.0f));
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) CHECK(glm::length(light(random_direction(random))) == 0.0f);
}

TEST_CASE("with windows all around, the open sky and its harmonics are unchanged") {
  const Enclosure room{[](vec3) { return true; }, [](vec3) { return vec3(0.5f); }};
  const Radiance open = day_sky(kSun);
  const Irradiance without = project_irradiance(open),
                   with = project_irradiance(indoor_radiance(room, open, kSun, vec3(3.0f)));
  for (std::size_t i = 0; i < without.c.size(); ++i) CHECK(without.c[i] == with.c[i]);
}

TEST_CASE("the lining's radiance is the geometric series of what comes in: albedo L f / (1 - albedo (1 - f))") {
  // A sky of constant radiance L is visible through a fraction f of the sphere, so its direct irradiance E gives E / pi
  // = L f. Of the light that reaches the room's lining, a fraction albedo * (1 - f) reaches the lining again, and so
  // on.
  const vec3 sky(0.7f, 1.0f, 1.4f), albedo(0.3f, 0.5f, 0.8f);
  std::mt19937 random(2);
  for (const float fraction : {0.1f, 0.25f, 0.6f}) {
    const Enclosure room = cap(fraction, albedo);
    const Radiance light = indoor_radiance(room, constant(sky), kSun, kDark);
    vec3 round = sky * fraction, sum(0.0f);
    for (int i = 0; i < 200; ++i, round *= albedo * (1.0f - fraction)) sum += albedo * round;
    for (int i = 0; i < 50; ++i) {
      const vec3 d = random_direction(random), measured = light(d);
      const vec3 expected = room.window(d) ? sky : sum;
      CAPTURE(fraction);
      for (int c = 0; c < 3; ++c) CHECK(measured[c] == doctest::Approx(expected[c]).epsilon(0.05));
    }
  }
}

TEST_CASE("white lining in a constant sky is as bright as the sky: light is lost only through the windows") {
  const Radiance light = indoor_radiance(cap(0.3f, vec3(0.99999f)), constant(vec3(0.8f)), kSun, kDark);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) CHECK(light(random_direction(random)).y == doctest::Approx(0.8).epsilon(0.01));
}

TEST_CASE("black lining is black, lit or not") {
  const Enclosure room = cap(0.3f, vec3(0.0f));
  const Radiance light = indoor_radiance(room, day_sky(kSun), kSun, vec3(3.0f));
  CHECK(light({0, 0, -1}) == vec3(0.0f));
  CHECK(light({0, 0, 1}) == day_sky(kSun)({0, 0, 1}));
}

TEST_CASE("the sun adds S cos / pi where its ray enters, and interreflected light everywhere") {
  // Light comes only from a sun of irradiance S, through a window that covers a fraction f of all directions and is
  // centred on the sun. The sun lights the opposite cap of the unit sphere, which has the height h = 2 f. The mean
  // irradiance of the sphere is the integral of S cos(angle of incidence) over that cap, divided by 4 pi: S (1 - (1 -
  // h)^2) / 4.
  const float fraction = 0.1f, albedo = 0.4f, sun = 3.0f, height = 2.0f * fraction;
  const Enclosure room = cap(fraction, vec3(albedo));
  const Radiance light = indoor_radiance(room, constant(kDark), {0, 0, 1}, vec3(sun));
  const double first_bounce = albedo * sun * (1.0 - std::pow(1.0 - height, 2.0)) / 4.0;
  const double interreflected = first_bounce / (1.0 - albedo * (1.0 - fraction));
  const double lit = albedo * (sun + interreflected) / glm::pi<double>(),
               unlit = albedo * interreflected / glm::pi<double>();
  CHECK(light({0, 0, -1}).x == doctest::Approx(lit).epsilon(0.02));
  CHECK(light({1, 0, 0}).x == doctest::Approx(unlit).epsilon(0.1));
  CHECK(light({0, 0, 1}).x == 0.0f);
}

TEST_CASE("in the cabin the ceiling is neutral and darker than the sky that it hides") {
  const Radiance open = day_sky(kSun);
  const Enclosure cabin = car_cabin();
  const Radiance light = indoor_radiance(cabin, open, kSun, vec3(3.2f, 3.0f, 2.7f));
  const double windows = fraction_of_directions(cabin.window);
  MESSAGE("windows: " << 100.0 * windows << " % of all directions");
  const vec3 ceiling = light({0, 1, 0}), zenith = open({0, 1, 0});
  MESSAGE("ceiling " << ceiling.x << " " << ceiling.y << " " << ceiling.z);
  CHECK(ceiling.z < 1.1f * ceiling.x);
  CHECK(zenith.z > 2.0f * zenith.x);
  CHECK(glm::dot(ceiling, vec3(1.0f)) < glm::dot(zenith, vec3(1.0f)));
  const vec3 up = project_irradiance(light)({0, 1, 0}), up_open = project_irradiance(open)({0, 1, 0});
  MESSAGE("upwards " << up.x << " " << up.y << " " << up.z << ", in the open " << up_open.x << " " << up_open.y << " "
                     << up_open.z);
  CHECK(up.x < 0.6f * up_open.x);
  CHECK(up.z / up.x < up_open.z / up_open.x);
}
