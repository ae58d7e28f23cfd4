#include "app/stage/patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gearshift {
namespace {

constexpr float kSmooth = 0.766f;  // cosine of 40 deg

// Tangents lie along +x where they can: the surfaces here carry no normal map.
glm::vec4 tangent_of(glm::vec3 normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
  return {glm::normalize(axis - normal * glm::dot(axis, normal)), 1.0f};
}

std::uint32_t push(Patch& patch, glm::vec3 position, glm::vec3 normal, std::uint32_t colour) {
  Vertex vertex;
  vertex.position = position;
  vertex.normal = normal;
  vertex.tangent = tangent_of(normal);
  vertex.colour = colour;
  patch.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(patch.vertices.size() - 1);
}

Primitive append_part(Model& model, const MeshPiece& piece) {
  Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(model.indices.size());
  primitive.index_count = static_cast<std::uint32_t>(piece.patch.indices.size());
  primitive.material = piece.material;
  primitive.low = primitive.high = piece.patch.vertices.front().position;
  const auto base = static_cast<std::uint32_t>(model.vertices.size());
  for (const Vertex& vertex : piece.patch.vertices) {
    primitive.low = glm::min(primitive.low, vertex.position);
    primitive.high = glm::max(primitive.high, vertex.position);
    model.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : piece.patch.indices) model.indices.push_back(base + index);
  if (!model.vertex_joints.empty()) model.vertex_joints.resize(model.vertices.size());
  return primitive;
}

}  // namespace

std::uint32_t linear_rgba(glm::vec3 colour) noexcept {
  const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f))); };
  return byte(colour.x) | byte(colour.y) << 8 | byte(colour.z) << 16 | 0xff000000u;
}

glm::vec3 above(glm::dvec2 plate, double height) noexcept {
  return {glm::dvec3(plate.x, height, -plate.y)};
}

void add_flat(Patch& patch, std::span<const glm::dvec2> corners, double height, std::uint32_t colour) {
  for (const glm::dvec2 corner : corners) {
    patch.indices.push_back(push(patch, above(corner, height), {0.0f, 1.0f, 0.0f}, colour));
  }
}

void add_wall(Patch& patch, Rim top, Rim bottom, Seen seen) {
  const std::size_t n = top.loop.size();
  const auto next = [n](std::size_t i) { return (i + 1) % n; };
  const float sign = seen == Seen::from_left ? 1.0f : -1.0f;
  std::vector<glm::vec3> face(n);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::vec3 along = above(top.loop[next(i)], top.height) - above(top.loop[i], top.height);
    const glm::vec3 down = above(bottom.loop[i], bottom.height) - above(top.loop[i], top.height);
    face[i] = sign * glm::normalize(glm::cross(along, down));
  }
  const auto shade = [&](std::size_t own, std::size_t other) {
    return glm::dot(face[own], face[other]) > kSmooth ? glm::normalize(face[own] + face[other]) : face[own];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const glm::vec3 first = shade(i, (i + n - 1) % n), second = shade(i, next(i));
    const std::uint32_t a = push(patch, above(top.loop[i], top.height), first, top.colour);
    const std::uint32_t b = push(patch, above(top.loop[next(i)], top.height), second, top.colour);
    const std::uint32_t c = push(patch, above(bottom.loop[next(i)], bottom.height), second, bottom.colour);
    const std::uint32_t d = push(patch, above(bottom.loop[i], bottom.height), first, bottom.colour);
    if (seen == Seen::from_left) {
      patch.indices.insert(patch.indices.end(), {a, b, c, a, c, d});
    } else {
      patch.indices.insert(patch.indices.end(), {a, c, b, a, d, c});
    }
  }
}

int add_mesh(Model& model, std::string name, std::span<const MeshPiece> pieces) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.first_vertex = static_cast<std::uint32_t>(model.vertices.size());
  for (const MeshPiece& piece : pieces) {
    if (!piece.patch.indices.empty()) mesh.primitives.push_back(append_part(model, piece));
  }
  mesh.vertex_count = static_cast<std::uint32_t>(model.vertices.size()) - mesh.first_vertex;
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

int add_mesh_node(Model& model, std::string name, std::span<const MeshPiece> pieces, glm::vec3 translation,
                  int parent) {
  Node node;
  node.mesh = add_mesh(model, name, pieces);
  node.name = std::move(name);
  node.parent = parent;
  node.translation = translation;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace gearshift
