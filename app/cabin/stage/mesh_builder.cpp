#include "app/cabin/stage/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gearshift::cabin {
namespace {

constexpr float kSmooth = 0.766f;  // cosine of 40 deg, the largest angle between faces with smooth shading

// A tangent for a normal, along +x where possible. The tangent's direction does not matter, because these surfaces have
// no normal map.
glm::vec4 tangent_of(glm::vec3 normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
  return {glm::normalize(axis - normal * glm::dot(axis, normal)), 1.0f};
}

std::uint32_t push(MeshData& mesh_data, glm::vec3 position, glm::vec3 normal, std::uint32_t colour) {
  engine::Vertex vertex;
  vertex.position = position;
  vertex.normal = normal;
  vertex.tangent = tangent_of(normal);
  vertex.colour = colour;
  mesh_data.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh_data.vertices.size() - 1);
}

engine::Primitive append_part(engine::Model& model, const MaterialPart& part) {
  engine::Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(model.indices.size());
  primitive.index_count = static_cast<std::uint32_t>(part.mesh_data.indices.size());
  primitive.material = part.material;
  primitive.low = primitive.high = part.mesh_data.vertices.front().position;
  const auto base = static_cast<std::uint32_t>(model.vertices.size());
  for (const engine::Vertex& vertex : part.mesh_data.vertices) {
    primitive.low = glm::min(primitive.low, vertex.position);
    primitive.high = glm::max(primitive.high, vertex.position);
    model.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : part.mesh_data.indices) model.indices.push_back(base + index);
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

void add_flat(MeshData& mesh_data, std::span<const glm::dvec2> corners, double height, std::uint32_t colour) {
  for (const glm::dvec2 corner : corners) {
    mesh_data.indices.push_back(push(mesh_data, above(corner, height), {0.0f, 1.0f, 0.0f}, colour));
  }
}

void add_wall(MeshData& mesh_data, Rim top, Rim bottom, WallFace visible_side) {
  const std::size_t n = top.loop.size();
  const auto next = [n](std::size_t i) { return (i + 1) % n; };
  const float sign = visible_side == WallFace::from_left ? 1.0f : -1.0f;
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
    const std::uint32_t a = push(mesh_data, above(top.loop[i], top.height), first, top.colour);
    const std::uint32_t b = push(mesh_data, above(top.loop[next(i)], top.height), second, top.colour);
    const std::uint32_t c = push(mesh_data, above(bottom.loop[next(i)], bottom.height), second, bottom.colour);
    const std::uint32_t d = push(mesh_data, above(bottom.loop[i], bottom.height), first, bottom.colour);
    if (visible_side == WallFace::from_left) {
      mesh_data.indices.insert(mesh_data.indices.end(), {a, b, c, a, c, d});
    } else {
      mesh_data.indices.insert(mesh_data.indices.end(), {a, c, b, a, d, c});
    }
  }
}

int add_mesh(engine::Model& model, std::string name, std::span<const MaterialPart> parts) {
  engine::Mesh mesh;
  mesh.name = std::move(name);
  mesh.first_vertex = static_cast<std::uint32_t>(model.vertices.size());
  for (const MaterialPart& part : parts) {
    if (!part.mesh_data.indices.empty()) mesh.primitives.push_back(append_part(model, part));
  }
  mesh.vertex_count = static_cast<std::uint32_t>(model.vertices.size()) - mesh.first_vertex;
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

int add_mesh_node(engine::Model& model, std::string name, std::span<const MaterialPart> parts, glm::vec3 translation,
                  int parent) {
  engine::Node node;
  node.mesh = add_mesh(model, name, parts);
  node.name = std::move(name);
  node.parent = parent;
  node.translation = translation;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace gearshift::cabin
