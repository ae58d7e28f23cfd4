// Compares irradiance from nine spherical-harmonic coefficients with known integrals.
#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "engine/light/environment.h"

using namespace gearshift::engine;
using glm::vec3;

namespace {

vec3 any_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

// Irradiance / pi, summed over a Fibonacci sphere. Method and directions are independent of the code under test.
vec3 summed(const Radiance& radiance, vec3 n, int count = 40000) {
  vec3 sum(0.0f);
  for (int i = 0; i < count; ++i) {
    const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const float phi = static_cast<float>(i) * 2.39996323f, r = std::sqrt(1.0f - z * z);
    const vec3 d(r * std::cos(phi), r * std::sin(phi), z);
    sum += std::max(glm::dot(d, n), 0.0f) * radiance(d);
  }
  return 4.0f / static_cast<float>(count) * sum;
}

}  // namespace

TEST_CASE("under a constant sky L, every surface has E / pi = L") {
  const Irradiance irradiance = project_irradiance([](vec3) { return vec3(0.3f, 0.7f, 1.5f); });
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const vec3 e = irradiance(any_direction(random));
    CHECK(e.x == doctest::Approx(0.3).epsilon(1e-4));
    CHECK(e.y == doctest::Approx(0.7).epsilon(1e-4));
    CHECK(e.z == doctest::Approx(1.5).epsilon(1e-4));
  }
}

TEST_CASE("radiance of degree 1 comes back by 2/3, of degree 2 by 1/4: exact for what nine coefficients hold") {
  const vec3 axis = glm::normalize(vec3(1.0f, 2.0f, -0.5f));
  const Irradiance linear = project_irradiance([=](vec3 d) { return vec3(glm::dot(d, axis)); }, 128);
  const Irradiance square =
      project_irradiance([=](vec3 d) { return vec3(1.5f * glm::dot(d, axis) * glm::dot(d, axis) - 0.5f); }, 128);
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const vec3 n = any_direction(random);
    const float c = glm::dot(n, axis);
    CHECK(std::abs(linear(n).x - 2.0f / 3.0f * c) < 2e-4f);
    CHECK(std::abs(square(n).x - 0.25f * (1.5f * c * c - 0.5f)) < 2e-4f);
  }
}

TEST_CASE("under a clamped cosine sky, degree 2 is off by less than 1 % of the peak, as the series predicts") {
  // The radiance is max(d.a, 0) in direction d, with a = +Y. A surface with normal a has the largest irradiance E, with
  // E / pi = 2/3. The projection neglects the terms of degree 4 and higher. For this surface they contribute 1/192 =
  // 0.0052, which is below the tolerance of 1 % of 2/3 = 0.0067.
  const Irradiance irradiance = project_irradiance([](vec3 d) { return vec3(std::max(d.y, 0.0f)); }, 128);
  CHECK(std::abs(irradiance(vec3(0, 1, 0)).x - 2.0f / 3.0f) < 0.0067f);
  float worst = 0.0f;
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const vec3 n = any_direction(random);
    worst = std::max(worst, std::abs(irradiance(n).x - summed([](vec3 d) { return vec3(std::max(d.y, 0.0f)); }, n).x));
  }
  CHECK(worst < 0.0067f);
  CHECK(worst > 0.001f);  // the error of the neglected terms is visible to this comparison
}

TEST_CASE("the day sky's irradiance differs from the summed one by less than 4 % of the peak") {
  const Radiance sky = day_sky({0.35f, 0.80f, -0.48f});
  const Irradiance irradiance = project_irradiance(sky);
  const vec3 up = summed(sky, {0.0f, 1.0f, 0.0f});
  const float peak = std::max({up.x, up.y, up.z});
  float worst = 0.0f;
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const vec3 n = any_direction(random), error = glm::abs(irradiance(n) - summed(sky, n));
    worst = std::max({worst, error.x, error.y, error.z});
  }
  MESSAGE("worst error of degree 2: " << worst / peak << " of the peak " << peak);
  CHECK(worst < 0.04f * peak);
}

TEST_CASE("the day sky is finite and positive everywhere, brighter above than below, brightest towards the sun") {
  const vec3 sun = glm::normalize(vec3(0.35f, 0.80f, -0.48f));
  const Radiance sky = day_sky(sun);
  std::mt19937 random(5);
  const float towards_sun = glm::dot(sky(sun), vec3(1.0f));
  for (int i = 0; i < 2000; ++i) {
    const vec3 d = any_direction(random), l = sky(d);
    CHECK(std::isfinite(glm::dot(l, l)));
    CHECK(std::min({l.x, l.y, l.z}) > 0.0f);
    CHECK(glm::dot(l, vec3(1.0f)) <= towards_sun);
  }
  CHECK(glm::dot(sky({0, 1, 0}), vec3(1.0f)) > 2.0f * glm::dot(sky({0, -1, 0}), vec3(1.0f)));
  // The sky's radiance does not jump at the horizon.
  const vec3 just_above = sky(glm::normalize(vec3(1, 1e-4f, 1))), just_below = sky(glm::normalize(vec3(1, -1e-4f, 1)));
  CHECK(glm::length(just_above - just_below) < 0.01f);
}
