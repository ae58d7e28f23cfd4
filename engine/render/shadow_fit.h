// Where the sun's shadow map looks from.
#pragma once

#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/render/frustum.h"

namespace gearshift {

// Corners of the part of a box that is seen through clip spaces; all of the box where none of it is seen. [m] world
std::vector<glm::vec3> seen_corners(const Box& box, std::span<const glm::mat4> clip_from_world);

struct ShadowFit {
  glm::mat4 clip_from_world{1.0f};    // of the pass that draws it
  glm::mat4 shadow_from_world{1.0f};  // texture coordinates and depth, for looking it up
  float texel = 0.0f;                 // [m] width on a surface that faces the sun
};

// A square that holds the points as the sun sees them. Its width is a power of the fourth root of two, its middle moves
// in sixteenths of that and in whole texels: an eye that moves a little leaves the map as it is, one that moves more
// lets no shadow crawl. Depth 1 is towards the sun, 0 at the deepest point; casters up to kCasterReach before the points
// are drawn. At least one point.
ShadowFit fit_shadow(std::span<const glm::vec3> points, glm::vec3 towards_sun, int side);

inline constexpr float kCasterReach = 20.0f;  // [m]
inline constexpr int kShadowMargin = 2;       // [texels] at the map's edge that stay empty: what lies outside is lit

}  // namespace gearshift
