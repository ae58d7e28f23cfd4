// Directions of the texels of a cube map, with faces in Vulkan's order.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace gearshift::engine {

// Returns the point (s, t) of a face of the cube [-1, 1]^3; not a unit vector. Vulkan 1.3, section 16.5.4 "Cube Map
// Face Selection": s and t in [-1, 1] run right and down on faces +X -X +Y -Y +Z -Z.
inline glm::vec3 cube_point(int face, float s, float t) {
  switch (face) {
    case 0:
      return {1.0f, -t, -s};
    case 1:
      return {-1.0f, -t, s};
    case 2:
      return {s, 1.0f, t};
    case 3:
      return {s, -1.0f, -t};
    case 4:
      return {s, -t, 1.0f};
    default:
      return {-s, -t, -1.0f};
  }
}

// Unit direction through the centre of a texel, on a face of side x side texels.
inline glm::vec3 cube_direction(int face, int side, int x, int y) {
  const float texel = 2.0f / static_cast<float>(side);
  return glm::normalize(
      cube_point(face, (static_cast<float>(x) + 0.5f) * texel - 1.0f, (static_cast<float>(y) + 0.5f) * texel - 1.0f));
}

// Solid angle [sr] of the part of a face between its centre and (s, t): atan2(s t, sqrt(1 + s^2 + t^2)).
inline double cube_corner_angle(double s, double t) {
  return std::atan2(s * t, std::sqrt(s * s + t * t + 1.0));
}

// Solid angle [sr] of one texel, on a face of side x side texels.
inline double cube_texel_angle(int side, int x, int y) {
  const double texel = 2.0 / side, s = x * texel - 1.0, t = y * texel - 1.0;
  return cube_corner_angle(s, t) - cube_corner_angle(s + texel, t) - cube_corner_angle(s, t + texel) +
         cube_corner_angle(s + texel, t + texel);
}

}  // namespace gearshift::engine
