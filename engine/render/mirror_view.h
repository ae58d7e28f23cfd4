// What an eye sees in a plane mirror.
#pragma once

#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/render/frustum.h"
#include "engine/scene/view.h"

namespace gearshift {

// The mirror as a window: a rectangle in the plane z = 0 of its node, seen from +Z.
struct MirrorWindow {
  glm::vec3 origin{0.0f}, right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f};  // world; unit
  glm::vec3 normal{0.0f, 0.0f, 1.0f};
  glm::vec2 low{0.0f}, high{0.0f};  // [m] from the origin, along right and up
  float aspect() const { return (high.x - low.x) / (high.y - low.y); }

  // Texture coordinates of its picture, as rows over (world, 1). The picture is what the mirrored eye sees through the
  // window, and that eye looks at it from behind: its u runs against `right`.
  glm::vec4 u_row() const;
  glm::vec4 v_row() const;
};
MirrorWindow mirror_window(const glm::mat4& world, const Box& mesh);

// The view from the mirrored eye, off-axis through the window: its near plane is the mirror, so that nothing behind the
// mirror is seen. Empty where the eye is behind the mirror or on it.
std::optional<View> mirror_view(const MirrorWindow& window, glm::vec3 eye);

}  // namespace gearshift
