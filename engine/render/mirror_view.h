// The view of an eye in a plane mirror.
#pragma once

#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/render/frustum.h"
#include "engine/scene/view.h"

namespace gearshift::engine {

// The mirror as a window: a rectangle in the plane z = 0 of its node, visible from +Z.
struct MirrorWindow {
  glm::vec3 origin{0.0f}, right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f};  // in world space; right, up: unit vectors
  glm::vec3 normal{0.0f, 0.0f, 1.0f};
  glm::vec2 low{0.0f}, high{0.0f};  // [m] from the origin, along right and up
  float aspect() const { return (high.x - low.x) / (high.y - low.y); }

  // The dot products of u_row() and v_row() with (world point, 1) are the point's texture coordinates in the mirror's
  // picture. The mirrored eye looks through the window from behind, so u decreases along `right`.
  glm::vec4 u_row() const;
  glm::vec4 v_row() const;
};
MirrorWindow mirror_window(const glm::mat4& world, const Box& mesh);

// The view from the mirrored eye, off-axis through the window. The near plane is the plane of the mirror, so that
// nothing behind the mirror is drawn. Empty if the eye is behind the mirror or in its plane.
std::optional<View> mirror_view(const MirrorWindow& window, glm::vec3 eye);

}  // namespace gearshift::engine
