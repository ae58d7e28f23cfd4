#include "app/stage/mirror_image.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace gearshift {
namespace {

// S L S, S the mirror at x = 0: a node's frame is mirrored in its parent's and its own x alike.
void mirror_place(Node& node) {
  node.translation.x = -node.translation.x;
  node.rotation.y = -node.rotation.y;
  node.rotation.z = -node.rotation.z;
}

// As the joints' frames: from the mirrored mesh to the mirrored joint.
void mirror_skin(Skin& skin) {
  const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), {-1.0f, 1.0f, 1.0f});
  for (glm::mat4& bind : skin.inverse_bind) bind = mirror * bind * mirror;
}

void mirror_primitive(Model& model, Primitive& primitive) {
  const auto first = model.indices.begin() + primitive.first_index;
  for (std::uint32_t i = 0; i < primitive.index_count; i += 3) std::iter_swap(first + i + 1, first + i + 2);
  const float low = primitive.low.x;
  primitive.low.x = -primitive.high.x;
  primitive.high.x = -low;
}

}  // namespace

void mirror_mesh(Model& model, int mesh) {
  Mesh& mirrored = model.meshes[static_cast<std::size_t>(mesh)];
  const auto first = model.vertices.begin() + mirrored.first_vertex;
  std::for_each(first, first + mirrored.vertex_count, [](Vertex& vertex) {
    vertex.position.x = -vertex.position.x;
    vertex.normal.x = -vertex.normal.x;
    vertex.tangent.x = -vertex.tangent.x;
    vertex.tangent.w = -vertex.tangent.w;  // the bitangent is a cross product
  });
  for (Primitive& primitive : mirrored.primitives) mirror_primitive(model, primitive);
}

void mirror_model(Model& model, float plane, std::span<const std::string_view> upright) {
  std::vector<bool> is_upright(model.nodes.size());
  std::vector<bool> is_done(model.meshes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    Node& node = model.nodes[i];
    const bool below_upright = node.parent != kNone && is_upright[static_cast<std::size_t>(node.parent)];
    is_upright[i] = below_upright || std::find(upright.begin(), upright.end(), node.name) != upright.end();
    if (!below_upright) mirror_place(node);
    if (node.parent == kNone) node.translation.x += 2.0f * plane;
    if (is_upright[i] || node.mesh == kNone || is_done[static_cast<std::size_t>(node.mesh)]) continue;
    is_done[static_cast<std::size_t>(node.mesh)] = true;
    mirror_mesh(model, node.mesh);
  }
  for (Skin& skin : model.skins) mirror_skin(skin);
}

}  // namespace gearshift
