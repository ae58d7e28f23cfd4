#include "app/stage/pieces.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gearshift {
namespace {

Patch patch_of(const Model& model, const Primitive& primitive) {
  Patch patch;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
    const std::uint32_t index = model.indices[primitive.first_index + i];
    const auto [at, is_new] = number.emplace(index, static_cast<std::uint32_t>(patch.vertices.size()));
    if (is_new) patch.vertices.push_back(model.vertices[index]);
    patch.indices.push_back(at->second);
  }
  return patch;
}

}  // namespace

int needed_node(const Model& model, std::string_view name) {
  const int node = model.node(name);
  if (node == kNone) throw std::runtime_error("the models have no node '" + std::string(name) + "'");
  return node;
}

int needed_material(const Model& model, std::string_view name) {
  const auto at = std::find_if(model.materials.begin(), model.materials.end(),
                               [&](const Material& material) { return material.name == name; });
  if (at == model.materials.end()) throw std::runtime_error("the models have no material '" + std::string(name) + "'");
  return static_cast<int>(at - model.materials.begin());
}

std::vector<Piece> pieces_of(const Model& model, int node) {
  std::vector<Piece> pieces;
  const int mesh = model.nodes[static_cast<std::size_t>(node)].mesh;
  if (mesh == kNone) return pieces;
  for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
    pieces.push_back({patch_of(model, primitive), primitive.material});
  }
  return pieces;
}

std::vector<Piece> placed_pieces(const Model& model, int node, const glm::mat4& placed) {
  std::vector<Piece> pieces = pieces_of(model, node);
  const glm::mat3 normal_turn = glm::transpose(glm::inverse(glm::mat3(placed)));
  for (Piece& piece : pieces) {
    for (Vertex& vertex : piece.patch.vertices) {
      vertex.position = glm::vec3(placed * glm::vec4(vertex.position, 1.0f));
      vertex.normal = glm::normalize(normal_turn * vertex.normal);
      vertex.tangent = glm::vec4(glm::normalize(glm::mat3(placed) * glm::vec3(vertex.tangent)), vertex.tangent.w);
    }
  }
  return pieces;
}

void set_pieces(Model& model, int node, const std::vector<Piece>& pieces) {
  std::vector<Piece> joined;
  for (const Piece& piece : pieces) {
    const auto same =
        std::find_if(joined.begin(), joined.end(), [&](const Piece& p) { return p.material == piece.material; });
    if (same == joined.end()) {
      joined.push_back(piece);
      continue;
    }
    const auto base = static_cast<std::uint32_t>(same->patch.vertices.size());
    same->patch.vertices.insert(same->patch.vertices.end(), piece.patch.vertices.begin(), piece.patch.vertices.end());
    for (const std::uint32_t index : piece.patch.indices) same->patch.indices.push_back(base + index);
  }
  std::vector<MeshPiece> views;
  views.reserve(joined.size());
  for (const Piece& piece : joined) views.push_back({piece.patch, piece.material});
  const std::string name = model.nodes[static_cast<std::size_t>(node)].name;
  model.nodes[static_cast<std::size_t>(node)].mesh = add_mesh(model, name, views);
}

void repaint(Model& model, std::string_view node, std::string_view from, std::string_view to) {
  const int at = needed_node(model, node);
  const int old_material = needed_material(model, from), new_material = needed_material(model, to);
  std::vector<Piece> pieces = pieces_of(model, at);
  for (Piece& piece : pieces) {
    if (piece.material == old_material) piece.material = new_material;
  }
  set_pieces(model, at, pieces);
}

void join_into(Model& model, std::string_view from, std::string_view into) {
  const int source = needed_node(model, from), target = needed_node(model, into);
  Node& taken = model.nodes[static_cast<std::size_t>(source)];
  const Node& kept = model.nodes[static_cast<std::size_t>(target)];
  if (taken.parent != kept.parent) {
    throw std::runtime_error("'" + std::string(from) + "' and '" + std::string(into) + "' have not the same parent");
  }
  std::vector<Piece> pieces = pieces_of(model, target);
  for (Piece& piece : placed_pieces(model, source, glm::inverse(kept.local()) * taken.local())) {
    pieces.push_back(std::move(piece));
  }
  taken.mesh = kNone;
  set_pieces(model, target, pieces);
}

void leave_behind(Model& model, std::string_view node, std::string_view material) {
  const int at = needed_node(model, node);
  const int left = needed_material(model, material);
  std::vector<Piece> going, staying;
  for (Piece& piece : pieces_of(model, at)) (piece.material == left ? staying : going).push_back(std::move(piece));
  set_pieces(model, at, going);
  if (staying.empty()) return;
  const int twin = add_twin(model, at, std::string(node) + "Still", model.nodes[static_cast<std::size_t>(at)].parent);
  set_pieces(model, twin, staying);
}

int add_twin(Model& model, int node, std::string name, int parent) {
  Node twin = model.nodes[static_cast<std::size_t>(node)];
  twin.name = std::move(name);
  twin.parent = parent;
  model.nodes.push_back(std::move(twin));
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace gearshift
