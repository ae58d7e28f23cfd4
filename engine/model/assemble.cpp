#include "engine/model/assemble.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gearshift::engine {

namespace {

template <typename T>
int size_of(const std::vector<T>& list) {
  return static_cast<int>(list.size());
}

void shift(int& index, int by) {
  if (index != kNone) index += by;
}

void append_materials(Model& target, const Model& part) {
  const int textures = size_of(target.textures);
  target.textures.insert(target.textures.end(), part.textures.begin(), part.textures.end());
  for (Material material : part.materials) {
    for (TextureUse* use : {&material.base_colour_map, &material.metal_rough_map, &material.normal_map,
                            &material.occlusion_map, &material.emissive_map}) {
      shift(use->texture, textures);
    }
    target.materials.push_back(std::move(material));
  }
}

// Appends the meshes of `part`. `materials`: number of materials in `target` before `part` was appended.
void append_meshes(Model& target, const Model& part, int materials) {
  const auto vertices = static_cast<std::uint32_t>(target.vertices.size());
  const auto indices = static_cast<std::uint32_t>(target.indices.size());
  for (Mesh mesh : part.meshes) {
    mesh.first_vertex += vertices;
    for (Primitive& primitive : mesh.primitives) {
      primitive.first_index += indices;
      shift(primitive.material, materials);
    }
    target.meshes.push_back(std::move(mesh));
  }
  for (const std::uint32_t index : part.indices) target.indices.push_back(vertices + index);
  target.vertices.insert(target.vertices.end(), part.vertices.begin(), part.vertices.end());
  if (target.vertex_joints.empty() && part.vertex_joints.empty()) return;
  target.vertex_joints.resize(vertices);
  target.vertex_joints.insert(target.vertex_joints.end(), part.vertex_joints.begin(), part.vertex_joints.end());
  target.vertex_joints.resize(target.vertices.size());
}

void append_skins(Model& target, const Model& part, int nodes) {
  for (Skin skin : part.skins) {
    for (int& joint : skin.joints) shift(joint, nodes);
    target.skins.push_back(std::move(skin));
  }
}

// Implements merge_static(): keeps all nodes of the model, and only those meshes that are still used.
class StaticMerge {
 public:
  StaticMerge(const Model& model, std::span<const std::string_view> moving)
      : model_(model), world_(rest_pose(model)), moves_(moving_nodes(model, moving)) {}

  Model merged() {
    out_.nodes = model_.nodes;
    out_.materials = model_.materials;
    out_.textures = model_.textures;
    out_.skins = model_.skins;
    out_.skipped = model_.skipped;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      Node& node = out_.nodes[i];
      if (node.mesh == kNone) continue;
      if (moves_[i] || node.skin != kNone) {
        node.mesh = copy_mesh(node.mesh);
      } else {
        parts_.push_back(i);
        node.mesh = kNone;
      }
    }
    if (!parts_.empty()) append_static_mesh();
    return std::move(out_);
  }

 private:
  static std::vector<bool> moving_nodes(const Model& model, std::span<const std::string_view> moving) {
    for (const std::string_view name : moving) {
      if (model.node(name) == kNone) throw std::invalid_argument(fmt::format("the model has no node '{}'", name));
    }
    std::vector<bool> moves;
    for (const Node& node : model.nodes) {
      const bool named = std::find(moving.begin(), moving.end(), node.name) != moving.end();
      moves.push_back(named || (node.parent != kNone && moves[static_cast<std::size_t>(node.parent)]));
    }
    return moves;
  }

  // Copies a mesh on its first use; returns its index in the result.
  int copy_mesh(int index) {
    const auto [known, is_new] = copied_.try_emplace(index, size_of(out_.meshes));
    if (!is_new) return known->second;
    Mesh mesh = model_.meshes[static_cast<std::size_t>(index)];
    const std::uint32_t shift = static_cast<std::uint32_t>(out_.vertices.size()) - mesh.first_vertex;  // modulo 2^32
    for (Primitive& primitive : mesh.primitives) {
      const auto first = model_.indices.begin() + primitive.first_index;
      primitive.first_index = static_cast<std::uint32_t>(out_.indices.size());
      std::transform(first, first + primitive.index_count, std::back_inserter(out_.indices),
                     [&](std::uint32_t i) { return i + shift; });
    }
    copy_range(model_.vertices, mesh, out_.vertices);
    if (!model_.vertex_joints.empty()) copy_range(model_.vertex_joints, mesh, out_.vertex_joints);
    mesh.first_vertex += shift;
    out_.meshes.push_back(std::move(mesh));
    return known->second;
  }

  template <typename T>
  static void copy_range(const std::vector<T>& from, const Mesh& mesh, std::vector<T>& to) {
    const auto first = from.begin() + mesh.first_vertex;
    to.insert(to.end(), first, first + mesh.vertex_count);
  }

  void append_static_mesh() {
    Mesh mesh{"Static", {}, static_cast<std::uint32_t>(out_.vertices.size()), 0};
    // Primitives by material, each with the index of the node that carries it.
    std::map<int, std::vector<std::pair<std::size_t, const Primitive*>>> by_material;
    for (const std::size_t node : parts_) {
      for (const Primitive& p : model_.meshes[static_cast<std::size_t>(model_.nodes[node].mesh)].primitives) {
        if (p.index_count > 0) by_material[p.material].emplace_back(node, &p);
      }
    }
    for (const auto& [material, primitives] : by_material) {
      Primitive joined;
      joined.material = material;
      joined.first_index = static_cast<std::uint32_t>(out_.indices.size());
      for (const auto& [node, primitive] : primitives) append_transformed(*primitive, world_[node]);
      joined.index_count = static_cast<std::uint32_t>(out_.indices.size()) - joined.first_index;
      measure(joined);
      mesh.primitives.push_back(joined);
    }
    mesh.vertex_count = static_cast<std::uint32_t>(out_.vertices.size()) - mesh.first_vertex;
    if (!model_.vertex_joints.empty()) out_.vertex_joints.resize(out_.vertices.size());
    Node root;
    root.name = "Static";
    root.mesh = size_of(out_.meshes);
    out_.meshes.push_back(std::move(mesh));
    out_.nodes.push_back(std::move(root));
  }

  // A mirroring transform turns triangles inside out and flips the bitangent.
  void append_transformed(const Primitive& primitive, const glm::mat4& world) {
    const glm::mat3 linear(world);
    const glm::mat3 for_normals = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0.0f;
    std::unordered_map<std::uint32_t, std::uint32_t> placed;
    for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
      const std::uint32_t corner = mirrored ? i - i % 3 + 2 - i % 3 : i;
      const std::uint32_t from = model_.indices[primitive.first_index + corner];
      const auto [known, is_new] = placed.try_emplace(from, static_cast<std::uint32_t>(out_.vertices.size()));
      if (is_new) {
        Vertex vertex = model_.vertices[from];
        vertex.position = glm::vec3(world * glm::vec4(vertex.position, 1.0f));
        vertex.normal = glm::normalize(for_normals * vertex.normal);
        vertex.tangent = glm::vec4(glm::normalize(linear * glm::vec3(vertex.tangent)),
                                   mirrored ? -vertex.tangent.w : vertex.tangent.w);
        out_.vertices.push_back(vertex);
      }
      out_.indices.push_back(known->second);
    }
  }

  void measure(Primitive& primitive) const {
    primitive.low = primitive.high = out_.vertices[out_.indices[primitive.first_index]].position;
    for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
      const glm::vec3 p = out_.vertices[out_.indices[primitive.first_index + i]].position;
      primitive.low = glm::min(primitive.low, p);
      primitive.high = glm::max(primitive.high, p);
    }
  }

  const Model& model_;
  std::vector<glm::mat4> world_;
  std::vector<bool> moves_;
  std::map<int, int> copied_;       // mesh in the model -> mesh in the result
  std::vector<std::size_t> parts_;  // nodes whose meshes are merged
  Model out_;
};

}  // namespace

int append_model(Model& target, const Model& part, int parent) {
  if (parent < kNone || parent >= size_of(target.nodes)) throw std::invalid_argument("append_model: no such parent");
  const int first = size_of(target.nodes), meshes = size_of(target.meshes), skins = size_of(target.skins);
  const int materials = size_of(target.materials);
  append_materials(target, part);
  append_meshes(target, part, materials);
  append_skins(target, part, first);
  for (Node node : part.nodes) {
    node.parent = node.parent == kNone ? parent : node.parent + first;
    shift(node.mesh, meshes);
    shift(node.skin, skins);
    target.nodes.push_back(std::move(node));
  }
  for (const std::string& name : part.skipped) {
    if (std::find(target.skipped.begin(), target.skipped.end(), name) == target.skipped.end()) {
      target.skipped.push_back(name);
    }
  }
  return first;
}

Model merge_static(const Model& model, std::span<const std::string_view> moving) {
  return StaticMerge(model, moving).merged();
}

int draw_count(const Model& model) {
  int count = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh != kNone) count += size_of(model.meshes[static_cast<std::size_t>(node.mesh)].primitives);
  }
  return count;
}

}  // namespace gearshift::engine
