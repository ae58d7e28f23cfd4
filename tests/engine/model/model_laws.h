// Checks that hold for every model that read_gltf() returns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "engine/model/model.h"

namespace gearshift::test {

inline bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool is_valid_vertex(const engine::Vertex& v) {
  const glm::vec3 tangent(v.tangent);
  return is_finite(v.position) && std::abs(glm::length(v.normal) - 1.0f) < 1e-3f &&
         std::abs(glm::length(tangent) - 1.0f) < 1e-3f && std::abs(v.tangent.w) == 1.0f;
}

inline bool is_index(int index, std::size_t count) {
  return index >= engine::kNone && index < static_cast<int>(count);
}

inline bool is_valid_mesh(const engine::Model& model, const engine::Mesh& mesh) {
  const std::uint64_t end = std::uint64_t{mesh.first_vertex} + mesh.vertex_count;
  if (end > model.vertices.size()) return false;
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const engine::Primitive& p) {
    if (p.index_count == 0 || p.index_count % 3 != 0 || !is_index(p.material, model.materials.size())) return false;
    if (std::uint64_t{p.first_index} + p.index_count > model.indices.size()) return false;
    const auto first = model.indices.begin() + p.first_index;
    return std::all_of(first, first + p.index_count, [&](std::uint32_t i) {
      const glm::vec3 at = model.vertices[i].position;
      return i >= mesh.first_vertex && i < end && glm::max(p.low, at) == at && glm::min(p.high, at) == at;
    });
  });
}

inline bool is_valid_material(const engine::Model& model, const engine::Material& m) {
  for (const engine::TextureUse* use :
       {&m.base_colour_map, &m.metal_rough_map, &m.normal_map, &m.occlusion_map, &m.emissive_map}) {
    if (!is_index(use->texture, model.textures.size()) || use->uv_set < 0 || use->uv_set > 1) return false;
  }
  const auto is_fraction = [](float v) { return v >= 0.0f && v <= 1.0f; };
  return is_fraction(m.metallic) && is_fraction(m.roughness) && is_fraction(m.occlusion_strength) &&
         is_finite(m.emissive);
}

inline bool has_valid_nodes(const engine::Model& model) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const engine::Node& n = model.nodes[i];
    if (n.parent < engine::kNone || n.parent >= static_cast<int>(i)) return false;
    if (!is_index(n.mesh, model.meshes.size()) || !is_index(n.skin, model.skins.size())) return false;
    if (n.skin == engine::kNone) continue;
    const engine::Mesh& mesh = model.meshes[static_cast<std::size_t>(n.mesh)];
    const std::size_t joints = model.skins[static_cast<std::size_t>(n.skin)].joints.size();
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      float sum = 0.0f;
      for (int k = 0; k < 4; ++k) {
        if (model.vertex_joints[mesh.first_vertex + v].joint[k] >= joints) return false;
        sum += model.vertex_joints[mesh.first_vertex + v].weight[k];
      }
      if (std::abs(sum - 1.0f) > 1e-4f) return false;
    }
  }
  return true;
}

inline bool is_valid(const engine::Model& model) {
  const std::size_t joints = model.vertex_joints.size();
  if (joints != 0 && joints != model.vertices.size()) return false;
  for (const engine::Texture& t : model.textures) {
    if (t.pixels.rgba.size() !=
        4 * static_cast<std::size_t>(t.pixels.width) * static_cast<std::size_t>(t.pixels.height)) {
      return false;
    }
  }
  const auto mesh = [&](const engine::Mesh& m) { return is_valid_mesh(model, m); };
  const auto material = [&](const engine::Material& m) { return is_valid_material(model, m); };
  return has_valid_nodes(model) && std::all_of(model.vertices.begin(), model.vertices.end(), is_valid_vertex) &&
         std::all_of(model.meshes.begin(), model.meshes.end(), mesh) &&
         std::all_of(model.materials.begin(), model.materials.end(), material);
}

}  // namespace gearshift::test
