// Placement of the sun's shadow map.
#pragma once

#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/render/frustum.h"

namespace gearshift::engine {

// Corners [m] in world space of the part of a box that the views see; all corners of the box if no part is visible.
std::vector<glm::vec3> visible_corners(const Box& box, std::span<const glm::mat4> clip_from_world);

struct ShadowFit {
  glm::mat4 clip_from_world{1.0f};    // for the pass that draws the map
  glm::mat4 shadow_from_world{1.0f};  // texture coordinates and depth, for the lookup
  float texel = 0.0f;                 // [m] texel width on a surface that faces the sun
};

// Returns a square map that contains the points as seen from the sun. The map's width is a power of the fourth root of
// two, and its centre moves in steps of a sixteenth of the width, rounded to whole texels. So a small movement of the
// eye leaves the map unchanged, and larger movements do not make shadows crawl. Depth is 1 towards the sun and 0 at the
// deepest point; casters up to kCasterReach in front of the points are drawn. Needs at least one point.
ShadowFit fit_shadow(std::span<const glm::vec3> points, glm::vec3 towards_sun, int side);

inline constexpr float kCasterReach = 20.0f;  // [m]
// [texels] border of the map that stays empty, so that points outside the map are lit
inline constexpr int kShadowMargin = 2;

}  // namespace gearshift::engine
