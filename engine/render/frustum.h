// What can be seen of a box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gearshift {

struct Box {
  glm::vec3 low{0.0f}, high{0.0f};
  glm::vec3 centre() const { return 0.5f * (low + high); }
};

Box united(const Box& a, const Box& b);

// The axis-aligned box around a box that is moved.
Box moved(const glm::mat4& world, const Box& box);

// The frusta of some clip spaces, depth in [0, 1]. A box is seen where at least one of them does not lie wholly beyond
// one of its planes: a few boxes near the corners are seen though they are not.
class Frusta {
 public:
  explicit Frusta(std::span<const glm::mat4> clip_from_world);
  bool see(const Box& box) const;

 private:
  std::vector<std::array<glm::vec4, 6>> planes_;
};

}  // namespace gearshift
