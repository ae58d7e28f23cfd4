#include "app/demo/still_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/model/skin.h"

namespace gearshift::demo {
namespace {

struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{-std::numeric_limits<float>::max()};
  void add(glm::vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

// Adds a skinned mesh to the bounding box. The box is computed from the posed vertices, because the mesh's joints
// determine its position.
void add_posed(const engine::Model& model, std::size_t node, const std::vector<glm::mat4>& world, Bounds& box) {
  std::vector<engine::Vertex> posed;
  engine::skin_vertices(model, static_cast<int>(node), world, posed);
  for (const engine::Vertex& vertex : posed) box.add(vertex.position);
}

void add_corners(const engine::Primitive& primitive, const glm::mat4& world, Bounds& box) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 at(corner & 1 ? primitive.high.x : primitive.low.x, corner & 2 ? primitive.high.y : primitive.low.y,
                       corner & 4 ? primitive.high.z : primitive.low.z);
    box.add(world * glm::vec4(at, 1.0f));
  }
}

Bounds bounds(const engine::Model& model) {
  Bounds box;
  const std::vector<glm::mat4> world = engine::rest_pose(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const engine::Node& node = model.nodes[i];
    if (node.mesh == engine::kNone) continue;
    if (node.skin != engine::kNone) {
      add_posed(model, i, world, box);
      continue;
    }
    for (const engine::Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      add_corners(primitive, world[i], box);
  }
  if (box.low.x > box.high.x) box.low = box.high = glm::vec3(0.0f);
  return box;
}

}  // namespace

engine::FrameScene still_scene(const engine::Model& model) {
  engine::FrameScene scene;
  const std::vector<glm::mat4> world = engine::rest_pose(model);
  scene.nodes.resize(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const engine::Node& node = model.nodes[i];
    scene.nodes[i].world = world[i];
    if (node.mesh == engine::kNone || node.skin == engine::kNone) continue;
    engine::DeformedMesh posed{node.mesh, {}, static_cast<int>(i)};
    engine::skin_vertices(model, posed.node, world, posed.vertices);
    if (posed.vertices.empty()) continue;  // the mesh has only lines or points, which are not drawn
    scene.deformed.push_back(std::move(posed));
    scene.nodes[i].world = glm::mat4(1.0f);  // skinned vertices are already in world space
  }
  return scene;
}

FittingView fitting_view(const engine::Model& model, double field) {
  const Bounds box = bounds(model);
  const glm::dvec3 centre = 0.5f * (box.low + box.high);
  const double radius = std::max(1e-3, 0.5 * static_cast<double>(glm::length(box.high - box.low)));
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.7, 0.5, 1.0));
  const double distance = radius / std::sin(field / 2.0);
  return {engine::look_at(centre + from * distance, centre), distance - radius};
}

}  // namespace gearshift::demo
