#include "app/cabin/stage/mesh_parts.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/model/assemble.h"

namespace gearshift::test {
namespace {

// One triangle in the plane x + y + z = 1.
cabin::MeshData slanted() {
  cabin::MeshData mesh_data;
  for (int i = 0; i < 3; ++i) {
    engine::Vertex vertex;
    vertex.position = glm::vec3(0.0f);
    vertex.position[i] = 1.0f;
    vertex.normal = glm::normalize(glm::vec3(1.0f));
    vertex.tangent = glm::vec4(glm::normalize(glm::vec3(1.0f, -1.0f, 0.0f)), 1.0f);
    mesh_data.vertices.push_back(vertex);
    mesh_data.indices.push_back(static_cast<std::uint32_t>(i));
  }
  return mesh_data;
}

// A model with the nodes "Rod" and "Knob", both children of "Lever", both with material 0. The rod is scaled and
// rotated.
engine::Model lever() {
  engine::Model model;
  model.materials.resize(1);
  engine::Node top;
  top.name = "Lever";
  top.translation = {0.1f, 0.2f, 0.3f};
  model.nodes.push_back(top);
  const cabin::MeshData mesh_data = slanted();
  const std::array<cabin::MaterialPart, 1> parts{cabin::MaterialPart{mesh_data, 0}};
  const int rod = cabin::add_mesh_node(model, "Rod", parts, {0.0f, -0.5f, 0.0f}, 0);
  model.nodes[static_cast<std::size_t>(rod)].scale = {0.25f, 1.0f, 0.25f};
  model.nodes[static_cast<std::size_t>(rod)].rotation = glm::angleAxis(0.7f, glm::vec3(0.0f, 1.0f, 0.0f));
  const int knob = cabin::add_mesh_node(model, "Knob", parts, {0.0f, 0.12f, 0.0f}, 0);
  model.nodes[static_cast<std::size_t>(knob)].rotation = glm::angleAxis(0.3f, glm::vec3(1.0f, 0.0f, 0.0f));
  return model;
}

glm::vec3 in_world(const engine::Model& model, const char* node, glm::vec3 position) {
  const glm::mat4 world = engine::rest_pose(model)[static_cast<std::size_t>(model.node(node))];
  return glm::vec3(world * glm::vec4(position, 1.0f));
}

}  // namespace

TEST_CASE("a part that is merged into a different node stays in place, and both need one draw") {
  engine::Model model = lever();
  std::array<glm::vec3, 3> before;
  for (std::size_t i = 0; i < 3; ++i) before[i] = in_world(model, "Rod", slanted().vertices[i].position);
  cabin::merge_into(model, "Rod", "Knob");
  CHECK(engine::draw_count(model) == 1);
  const std::vector<cabin::MeshPart> parts = cabin::parts_of(model, model.node("Knob"));
  REQUIRE(parts.size() == 1);
  REQUIRE(parts[0].mesh_data.vertices.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(glm::distance(in_world(model, "Knob", parts[0].mesh_data.vertices[3 + i].position), before[i]) < 1e-6f);
  }
}

TEST_CASE("a scaled part's normals stay perpendicular to its faces") {
  engine::Model model = lever();
  cabin::merge_into(model, "Rod", "Knob");
  const std::vector<engine::Vertex> corner = cabin::parts_of(model, model.node("Knob"))[0].mesh_data.vertices;
  const glm::vec3 across =
      glm::normalize(glm::cross(corner[4].position - corner[3].position, corner[5].position - corner[3].position));
  for (std::size_t i = 3; i < 6; ++i) {
    CHECK(glm::dot(corner[i].normal, across) > 0.9999f);
    CHECK(std::abs(glm::dot(glm::vec3(corner[i].tangent), across)) < 1e-4f);
  }
}

TEST_CASE("parts with different parents do not move together, so they are not merged") {
  engine::Model model = lever();
  model.nodes[static_cast<std::size_t>(model.node("Rod"))].parent = engine::kNone;
  CHECK_THROWS_AS(cabin::merge_into(model, "Rod", "Knob"), std::runtime_error);
  CHECK_THROWS_AS(cabin::merge_into(model, "Road", "Knob"), std::runtime_error);
}

}  // namespace gearshift::test
