#include "engine/model/skin.h"

#include <glm/geometric.hpp>

namespace gearshift::engine {

namespace {

// A vector of zero length is returned unchanged.
glm::vec3 unit(glm::vec3 v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : v;
}

}  // namespace

void skin_vertices(const Model& model, int node, std::span<const glm::mat4> world, std::vector<Vertex>& out) {
  const Node& carrier = model.nodes[static_cast<std::size_t>(node)];
  const Mesh& mesh = model.meshes[static_cast<std::size_t>(carrier.mesh)];
  const Skin& skin = model.skins[static_cast<std::size_t>(carrier.skin)];
  std::vector<glm::mat4> from_bind(skin.joints.size());
  for (std::size_t i = 0; i < from_bind.size(); ++i) {
    from_bind[i] = world[static_cast<std::size_t>(skin.joints[i])] * skin.inverse_bind[i];
  }
  out.resize(mesh.vertex_count);
  for (std::uint32_t i = 0; i < mesh.vertex_count; ++i) {
    const VertexJoints& joints = model.vertex_joints[mesh.first_vertex + i];
    glm::mat4 blend(0.0f);
    for (int k = 0; k < 4; ++k) blend += joints.weight[k] * from_bind[joints.joint[k]];
    out[i] = model.vertices[mesh.first_vertex + i];
    out[i].position = glm::vec3(blend * glm::vec4(out[i].position, 1.0f));
    out[i].normal = unit(glm::mat3(blend) * out[i].normal);
    out[i].tangent = glm::vec4(unit(glm::mat3(blend) * glm::vec3(out[i].tangent)), out[i].tangent.w);
  }
}

}  // namespace gearshift::engine
