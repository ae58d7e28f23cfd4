// Where the sun's shadow map looks from.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gearshift {

struct Sphere {
  glm::vec3 centre{0.0f};
  float radius = 1.0f;  // [m]
};

struct ShadowFit {
  glm::mat4 clip_from_world{1.0f};  // of the pass that draws it
  // Texture coordinates and depth, for looking it up: half a texel up and left, so that the four texels' quad about a
  // place starts there (sunlit() in mesh.frag).
  glm::mat4 shadow_from_world{1.0f};
  float texel = 0.0f;  // [m] width on a surface that faces the sun
};

// A square as wide as the sphere, whichever way it turns, moved in whole texels only: the shadow of what stands still
// does not crawl while the sphere moves. Depth 1 is towards the sun, 0 beyond the sphere; casters up to kCasterReach
// before the sphere are drawn.
ShadowFit fit_shadow(const Sphere& sphere, glm::vec3 towards_sun, int side);

inline constexpr float kCasterReach = 20.0f;  // [m]
inline constexpr int kShadowMargin = 2;       // [texels] at the map's edge that stay empty: what lies outside is lit

}  // namespace gearshift
