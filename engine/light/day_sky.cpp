#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/light/environment.h"

namespace gearshift::engine {

namespace {

// Radiances, in units in which a clear sky is about 1. Chosen by eye for a sun 45 to 60 degrees high.
constexpr glm::vec3 kZenith{0.25f, 0.42f, 0.74f};
constexpr glm::vec3 kHaze{1.00f, 1.02f, 1.04f};
constexpr glm::vec3 kGlow{0.70f, 0.58f, 0.42f};
constexpr glm::vec3 kAsphalt{0.15f, 0.15f, 0.16f};
constexpr glm::vec3 kVerge{0.17f, 0.21f, 0.09f};

constexpr float kEyeHeight = 1.1f;      // [m] above the road
constexpr float kRoadHalfWidth = 6.0f;  // [m] the road runs along z
constexpr float kSoftEdge = 2.0f;       // [m] blend from road to verge, so that reflections show no seam

glm::vec3 sky_radiance(glm::vec3 direction, glm::vec3 towards_sun) {
  // The haze increases with the air mass towards the horizon.
  const float haze = std::exp(-6.0f * direction.y);
  const float near_sun = glm::max(glm::dot(direction, towards_sun), 0.0f);
  const float glow = 0.5f * std::pow(near_sun, 6.0f) + 1.5f * std::pow(near_sun, 60.0f);
  return glm::mix(kZenith, kHaze, haze) + glow * kGlow;
}

glm::vec3 ground_radiance(glm::vec3 direction, glm::vec3 horizon) {
  const float metres_per_unit = kEyeHeight / -direction.y;
  const float aside = std::abs(direction.x) * metres_per_unit;
  const float verge = glm::smoothstep(kRoadHalfWidth, kRoadHalfWidth + kSoftEdge, aside);
  const float haze = std::exp(40.0f * direction.y);  // distant ground takes the colour of the horizon
  return glm::mix(glm::mix(kAsphalt, kVerge, verge), horizon, haze);
}

}  // namespace

Radiance day_sky(glm::vec3 towards_sun) {
  const glm::vec3 sun = glm::normalize(towards_sun);
  return [sun](glm::vec3 direction) {
    if (direction.y >= 0.0f) return sky_radiance(direction, sun);
    return ground_radiance(direction, sky_radiance(glm::vec3(direction.x, 0.0f, direction.z), sun));
  };
}

}  // namespace gearshift::engine
