#include "engine/render/shadow_fit.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace gearshift {

ShadowFit fit_shadow(const Sphere& sphere, glm::vec3 towards_sun, int side) {
  const glm::dvec3 z = glm::normalize(glm::dvec3(towards_sun));
  const glm::dvec3 aside = std::abs(z.y) < 0.99 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(aside, z)), y = glm::cross(z, x);

  // The margin is no part of the sphere's picture.
  const double radius = sphere.radius * static_cast<double>(side) / (side - 2 * kShadowMargin);
  const double texel = 2.0 * radius / side;
  const auto snapped = [&](const glm::dvec3& axis) {
    return texel * std::round(glm::dot(axis, glm::dvec3(sphere.centre)) / texel);
  };
  const double depth_range = 2.0 * sphere.radius + kCasterReach;
  const double deepest = glm::dot(z, glm::dvec3(sphere.centre)) - sphere.radius;

  glm::dmat4 clip(1.0);
  for (int i = 0; i < 3; ++i) {
    clip[i][0] = x[i] / radius;
    clip[i][1] = -y[i] / radius;
    clip[i][2] = z[i] / depth_range;
  }
  clip[3] = {-snapped(x) / radius, snapped(y) / radius, -deepest / depth_range, 1.0};

  glm::dmat4 texture(1.0);
  texture[0][0] = texture[1][1] = 0.5;
  texture[3] = {0.5 - 0.5 / side, 0.5 - 0.5 / side, 0.0, 1.0};
  return {glm::mat4(clip), glm::mat4(texture * clip), static_cast<float>(texel)};
}

}  // namespace gearshift
