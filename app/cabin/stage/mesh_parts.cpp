#include "app/cabin/stage/mesh_parts.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gearshift::cabin {
namespace {

MeshData mesh_data_of(const engine::Model& model, const engine::Primitive& primitive) {
  MeshData mesh_data;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
    const std::uint32_t index = model.indices[primitive.first_index + i];
    const auto [at, is_new] = number.emplace(index, static_cast<std::uint32_t>(mesh_data.vertices.size()));
    if (is_new) mesh_data.vertices.push_back(model.vertices[index]);
    mesh_data.indices.push_back(at->second);
  }
  return mesh_data;
}

}  // namespace

int required_node(const engine::Model& model, std::string_view name) {
  const int node = model.node(name);
  if (node == engine::kNone) throw std::runtime_error("no model has a node named '" + std::string(name) + "'");
  return node;
}

int required_material(const engine::Model& model, std::string_view name) {
  const auto at = std::find_if(model.materials.begin(), model.materials.end(),
                               [&](const engine::Material& material) { return material.name == name; });
  if (at == model.materials.end())
    throw std::runtime_error("no model has a material named '" + std::string(name) + "'");
  return static_cast<int>(at - model.materials.begin());
}

std::vector<MeshPart> parts_of(const engine::Model& model, int node) {
  std::vector<MeshPart> parts;
  const int mesh = model.nodes[static_cast<std::size_t>(node)].mesh;
  if (mesh == engine::kNone) return parts;
  for (const engine::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
    parts.push_back({mesh_data_of(model, primitive), primitive.material});
  }
  return parts;
}

std::vector<MeshPart> transformed_parts(const engine::Model& model, int node, const glm::mat4& placed) {
  std::vector<MeshPart> parts = parts_of(model, node);
  const glm::mat3 normal_turn = glm::transpose(glm::inverse(glm::mat3(placed)));
  for (MeshPart& part : parts) {
    for (engine::Vertex& vertex : part.mesh_data.vertices) {
      vertex.position = glm::vec3(placed * glm::vec4(vertex.position, 1.0f));
      vertex.normal = glm::normalize(normal_turn * vertex.normal);
      vertex.tangent = glm::vec4(glm::normalize(glm::mat3(placed) * glm::vec3(vertex.tangent)), vertex.tangent.w);
    }
  }
  return parts;
}

void set_parts(engine::Model& model, int node, const std::vector<MeshPart>& parts) {
  std::vector<MeshPart> joined;
  for (const MeshPart& part : parts) {
    const auto same =
        std::find_if(joined.begin(), joined.end(), [&](const MeshPart& p) { return p.material == part.material; });
    if (same == joined.end()) {
      joined.push_back(part);
      continue;
    }
    const auto base = static_cast<std::uint32_t>(same->mesh_data.vertices.size());
    same->mesh_data.vertices.insert(same->mesh_data.vertices.end(), part.mesh_data.vertices.begin(),
                                    part.mesh_data.vertices.end());
    for (const std::uint32_t index : part.mesh_data.indices) same->mesh_data.indices.push_back(base + index);
  }
  std::vector<MaterialPart> views;
  views.reserve(joined.size());
  for (const MeshPart& part : joined) views.push_back({part.mesh_data, part.material});
  const std::string name = model.nodes[static_cast<std::size_t>(node)].name;
  model.nodes[static_cast<std::size_t>(node)].mesh = add_mesh(model, name, views);
}

void replace_material(engine::Model& model, std::string_view node, std::string_view from, std::string_view to) {
  const int at = required_node(model, node);
  const int old_material = required_material(model, from), new_material = required_material(model, to);
  std::vector<MeshPart> parts = parts_of(model, at);
  for (MeshPart& part : parts) {
    if (part.material == old_material) part.material = new_material;
  }
  set_parts(model, at, parts);
}

void merge_into(engine::Model& model, std::string_view from, std::string_view into) {
  const int source = required_node(model, from), target = required_node(model, into);
  engine::Node& moved_node = model.nodes[static_cast<std::size_t>(source)];
  const engine::Node& target_node = model.nodes[static_cast<std::size_t>(target)];
  if (moved_node.parent != target_node.parent) {
    throw std::runtime_error("'" + std::string(from) + "' and '" + std::string(into) + "' have different parents");
  }
  std::vector<MeshPart> parts = parts_of(model, target);
  for (MeshPart& part : transformed_parts(model, source, glm::inverse(target_node.local()) * moved_node.local())) {
    parts.push_back(std::move(part));
  }
  moved_node.mesh = engine::kNone;
  set_parts(model, target, parts);
}

void split_static_part(engine::Model& model, std::string_view node, std::string_view material) {
  const int at = required_node(model, node);
  const int left = required_material(model, material);
  std::vector<MeshPart> going, staying;
  for (MeshPart& part : parts_of(model, at)) (part.material == left ? staying : going).push_back(std::move(part));
  set_parts(model, at, going);
  if (staying.empty()) return;
  const int twin = add_twin(model, at, std::string(node) + "Still", model.nodes[static_cast<std::size_t>(at)].parent);
  set_parts(model, twin, staying);
}

int add_twin(engine::Model& model, int node, std::string name, int parent) {
  engine::Node twin = model.nodes[static_cast<std::size_t>(node)];
  twin.name = std::move(name);
  twin.parent = parent;
  model.nodes.push_back(std::move(twin));
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace gearshift::cabin
