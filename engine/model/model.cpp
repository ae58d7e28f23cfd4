#include "engine/model/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearshift::engine {

glm::mat3 TextureUse::matrix() const {
  const float c = std::cos(rotation), s = std::sin(rotation);
  return {{c * scale.x, -s * scale.x, 0.0f}, {s * scale.y, c * scale.y, 0.0f}, {offset.x, offset.y, 1.0f}};
}

glm::mat4 Node::local() const {
  glm::mat4 matrix = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
  matrix[3] = glm::vec4(translation, 1.0f);
  return matrix;
}

int Model::node(std::string_view name) const {
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.name == name; });
  return found == nodes.end() ? kNone : static_cast<int>(found - nodes.begin());
}

std::uint64_t Model::triangle_count() const {
  std::uint64_t count = 0;
  for (const Node& n : nodes) {
    if (n.mesh == kNone) continue;
    for (const Primitive& p : meshes[static_cast<std::size_t>(n.mesh)].primitives) count += p.index_count / 3;
  }
  return count;
}

std::vector<glm::mat4> rest_pose(const Model& model) {
  std::vector<glm::mat4> local(model.nodes.size());
  std::transform(model.nodes.begin(), model.nodes.end(), local.begin(), [](const Node& n) { return n.local(); });
  return world_from_local(model, local);
}

std::vector<glm::mat4> world_from_local(const Model& model, const std::vector<glm::mat4>& local) {
  if (local.size() != model.nodes.size())
    throw std::invalid_argument("world_from_local: one matrix per node is needed");
  std::vector<glm::mat4> world(local);
  for (std::size_t i = 0; i < world.size(); ++i) {
    const int parent = model.nodes[i].parent;
    if (parent != kNone) world[i] = world[static_cast<std::size_t>(parent)] * local[i];
  }
  return world;
}

}  // namespace gearshift::engine
