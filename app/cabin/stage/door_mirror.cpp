#include "app/cabin/stage/door_mirror.h"

#include <glm/geometric.hpp>

namespace gearshift::cabin {
namespace {

constexpr float kRadius = 1.2f;  // [m] minimum radius of curvature that UN Regulation 46 allows for door mirrors
constexpr float kTilt = 0.035f;  // [rad] tilt towards the ground

}  // namespace

void make_convex(MeshData& glass) {
  glm::vec3 middle(0.0f);
  for (const engine::Vertex& vertex : glass.vertices)
    middle += vertex.position / static_cast<float>(glass.vertices.size());
  for (engine::Vertex& vertex : glass.vertices) {
    const glm::vec3 off = vertex.position - middle;
    const glm::vec3 aside = off - glm::dot(off, vertex.normal) * vertex.normal;
    vertex.normal = glm::normalize(vertex.normal + aside / kRadius - glm::vec3(0.0f, kTilt, 0.0f));
  }
}

}  // namespace gearshift::cabin
