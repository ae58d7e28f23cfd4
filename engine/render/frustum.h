// Visibility of bounding boxes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gearshift::engine {

struct Box {
  glm::vec3 low{0.0f}, high{0.0f};
  glm::vec3 centre() const { return 0.5f * (low + high); }
};

Box united(const Box& a, const Box& b);

// Axis-aligned bounding box of a transformed box.
Box transformed(const glm::mat4& world, const Box& box);

// The frusta of one or more clip spaces with depth in [0, 1]. A box counts as invisible only if, for every frustum, it
// lies completely outside one plane of that frustum. So a few invisible boxes near the corners of a frustum count as
// visible.
class Frusta {
 public:
  explicit Frusta(std::span<const glm::mat4> clip_from_world);
  bool intersects(const Box& box) const;

 private:
  std::vector<std::array<glm::vec4, 6>> planes_;
};

}  // namespace gearshift::engine
