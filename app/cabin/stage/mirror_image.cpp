#include "app/cabin/stage/mirror_image.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace gearshift::cabin {
namespace {

// Replaces the node's local matrix L by S L S, where S mirrors at x = 0. This mirrors the node's position at its
// parent's plane x = 0, and the node's content at the plane x = 0 of the node.
void mirror_place(engine::Node& node) {
  node.translation.x = -node.translation.x;
  node.rotation.y = -node.rotation.y;
  node.rotation.z = -node.rotation.z;
}

// Mirrors the bind matrices in the same way as the joints, so that they map from the mirrored mesh to the mirrored
// joint.
void mirror_skin(engine::Skin& skin) {
  const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), {-1.0f, 1.0f, 1.0f});
  for (glm::mat4& bind : skin.inverse_bind) bind = mirror * bind * mirror;
}

void mirror_primitive(engine::Model& model, engine::Primitive& primitive) {
  const auto first = model.indices.begin() + primitive.first_index;
  for (std::uint32_t i = 0; i < primitive.index_count; i += 3) std::iter_swap(first + i + 1, first + i + 2);
  const float low = primitive.low.x;
  primitive.low.x = -primitive.high.x;
  primitive.high.x = -low;
}

}  // namespace

void mirror_mesh(engine::Model& model, int mesh) {
  engine::Mesh& mirrored = model.meshes[static_cast<std::size_t>(mesh)];
  const auto first = model.vertices.begin() + mirrored.first_vertex;
  std::for_each(first, first + mirrored.vertex_count, [](engine::Vertex& vertex) {
    vertex.position.x = -vertex.position.x;
    vertex.normal.x = -vertex.normal.x;
    vertex.tangent.x = -vertex.tangent.x;
    vertex.tangent.w = -vertex.tangent.w;  // mirroring reverses the bitangent, which is a cross product
  });
  for (engine::Primitive& primitive : mirrored.primitives) mirror_primitive(model, primitive);
}

void mirror_model(engine::Model& model, float plane, std::span<const std::string_view> upright) {
  std::vector<bool> is_upright(model.nodes.size());
  std::vector<bool> is_done(model.meshes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    engine::Node& node = model.nodes[i];
    const bool below_upright = node.parent != engine::kNone && is_upright[static_cast<std::size_t>(node.parent)];
    is_upright[i] = below_upright || std::find(upright.begin(), upright.end(), node.name) != upright.end();
    if (!below_upright) mirror_place(node);
    if (node.parent == engine::kNone) node.translation.x += 2.0f * plane;
    if (is_upright[i] || node.mesh == engine::kNone || is_done[static_cast<std::size_t>(node.mesh)]) continue;
    is_done[static_cast<std::size_t>(node.mesh)] = true;
    mirror_mesh(model, node.mesh);
  }
  for (engine::Skin& skin : model.skins) mirror_skin(skin);
}

}  // namespace gearshift::cabin
