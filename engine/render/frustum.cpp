#include "engine/render/frustum.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace gearshift::engine {

Box united(const Box& a, const Box& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Box transformed(const glm::mat4& world, const Box& box) {
  const glm::vec3 centre = glm::vec3(world * glm::vec4(box.centre(), 1.0f)), half = 0.5f * (box.high - box.low);
  const glm::vec3 reach = glm::abs(glm::vec3(world[0])) * half.x + glm::abs(glm::vec3(world[1])) * half.y +
                          glm::abs(glm::vec3(world[2])) * half.z;
  return {centre - reach, centre + reach};
}

// Derives the planes from the rows of the matrix (Gribb, Hartmann. Fast Extraction of Viewing Frustum Planes from the
// World-View-Projection Matrix. 2001).
Frusta::Frusta(std::span<const glm::mat4> clip_from_world) {
  for (const glm::mat4& clip : clip_from_world) {
    const glm::vec4 x = glm::row(clip, 0), y = glm::row(clip, 1), z = glm::row(clip, 2), w = glm::row(clip, 3);
    planes_.push_back({w + x, w - x, w + y, w - y, w - z, z});
  }
}

bool Frusta::intersects(const Box& box) const {
  const glm::vec3 centre = box.centre(), half = 0.5f * (box.high - box.low);
  return std::any_of(planes_.begin(), planes_.end(), [&](const auto& planes) {
    return std::none_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
      const glm::vec3 normal(plane);
      return glm::dot(normal, centre) + glm::dot(glm::abs(normal), half) + plane.w < 0.0f;
    });
  });
}

}  // namespace gearshift::engine
