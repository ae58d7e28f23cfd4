#include "app/render/still_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/model/skin.h"

namespace gearshift {
namespace {

struct Box {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{-std::numeric_limits<float>::max()};
};

Box bounds(const Model& model) {
  Box box;
  const std::vector<glm::mat4> world = rest_pose(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.mesh == kNone) continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? primitive.high.x : primitive.low.x,
                           corner & 2 ? primitive.high.y : primitive.low.y,
                           corner & 4 ? primitive.high.z : primitive.low.z);
        const glm::vec3 placed = world[i] * glm::vec4(at, 1.0f);
        box.low = glm::min(box.low, placed);
        box.high = glm::max(box.high, placed);
      }
    }
  }
  if (box.low.x > box.high.x) box.low = box.high = glm::vec3(0.0f);
  return box;
}

}  // namespace

FrameScene still_scene(const Model& model) {
  FrameScene scene;
  scene.shadow_reach = std::numeric_limits<float>::max();  // all of it
  const std::vector<glm::mat4> world = rest_pose(model);
  scene.nodes.resize(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    scene.nodes[i].world = world[i];
    if (node.mesh == kNone || node.skin == kNone) continue;
    DeformedMesh posed{node.mesh, {}};
    skin_vertices(model, static_cast<int>(i), world, posed.vertices);
    scene.deformed.push_back(std::move(posed));
    scene.nodes[i].world = glm::mat4(1.0f);  // skinned vertices are in the world
  }
  return scene;
}

EyePose fitting_eye(const Model& model, double vertical_fov, double aspect) {
  const Box box = bounds(model);
  const glm::dvec3 centre = 0.5f * (box.low + box.high);
  const double radius = std::max(1e-3, 0.5 * static_cast<double>(glm::length(box.high - box.low)));
  const double half = std::min(vertical_fov / 2.0, std::atan(std::tan(vertical_fov / 2.0) * aspect));
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.7, 0.5, 1.0));
  return look_at(centre + from * (radius / std::sin(half)), centre);
}

}  // namespace gearshift
