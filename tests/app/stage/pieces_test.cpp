#include "app/stage/pieces.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/model/assemble.h"

namespace gearshift {
namespace {

// One triangle in the plane x + y + z = 1, in a material of its own.
Patch slanted() {
  Patch patch;
  for (int i = 0; i < 3; ++i) {
    Vertex vertex;
    vertex.position = glm::vec3(0.0f);
    vertex.position[i] = 1.0f;
    vertex.normal = glm::normalize(glm::vec3(1.0f));
    vertex.tangent = glm::vec4(glm::normalize(glm::vec3(1.0f, -1.0f, 0.0f)), 1.0f);
    patch.vertices.push_back(vertex);
    patch.indices.push_back(static_cast<std::uint32_t>(i));
  }
  return patch;
}

// "Rod" and "Knob" beside each other below "Lever", both in material 0; the rod is squeezed and turned.
Model lever() {
  Model model;
  model.materials.resize(1);
  Node top;
  top.name = "Lever";
  top.translation = {0.1f, 0.2f, 0.3f};
  model.nodes.push_back(top);
  const Patch patch = slanted();
  const std::array<MeshPiece, 1> pieces{MeshPiece{patch, 0}};
  const int rod = add_mesh_node(model, "Rod", pieces, {0.0f, -0.5f, 0.0f}, 0);
  model.nodes[static_cast<std::size_t>(rod)].scale = {0.25f, 1.0f, 0.25f};
  model.nodes[static_cast<std::size_t>(rod)].rotation = glm::angleAxis(0.7f, glm::vec3(0.0f, 1.0f, 0.0f));
  const int knob = add_mesh_node(model, "Knob", pieces, {0.0f, 0.12f, 0.0f}, 0);
  model.nodes[static_cast<std::size_t>(knob)].rotation = glm::angleAxis(0.3f, glm::vec3(1.0f, 0.0f, 0.0f));
  return model;
}

glm::vec3 in_world(const Model& model, const char* node, glm::vec3 position) {
  const glm::mat4 world = rest_pose(model)[static_cast<std::size_t>(model.node(node))];
  return glm::vec3(world * glm::vec4(position, 1.0f));
}

}  // namespace

TEST_CASE("what is joined into another node stays where it was, in one draw") {
  Model model = lever();
  std::array<glm::vec3, 3> before;
  for (std::size_t i = 0; i < 3; ++i) before[i] = in_world(model, "Rod", slanted().vertices[i].position);
  join_into(model, "Rod", "Knob");
  CHECK(draw_count(model) == 1);
  const std::vector<Piece> pieces = pieces_of(model, model.node("Knob"));
  REQUIRE(pieces.size() == 1);
  REQUIRE(pieces[0].patch.vertices.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(glm::distance(in_world(model, "Knob", pieces[0].patch.vertices[3 + i].position), before[i]) < 1e-6f);
  }
}

TEST_CASE("a squeezed part's normals stay across its faces") {
  Model model = lever();
  join_into(model, "Rod", "Knob");
  const std::vector<Vertex> corner = pieces_of(model, model.node("Knob"))[0].patch.vertices;
  const glm::vec3 across =
      glm::normalize(glm::cross(corner[4].position - corner[3].position, corner[5].position - corner[3].position));
  for (std::size_t i = 3; i < 6; ++i) {
    CHECK(glm::dot(corner[i].normal, across) > 0.9999f);
    CHECK(std::abs(glm::dot(glm::vec3(corner[i].tangent), across)) < 1e-4f);
  }
}

TEST_CASE("parts of different parents do not move together and are not joined") {
  Model model = lever();
  model.nodes[static_cast<std::size_t>(model.node("Rod"))].parent = kNone;
  CHECK_THROWS_AS(join_into(model, "Rod", "Knob"), std::runtime_error);
  CHECK_THROWS_AS(join_into(model, "Road", "Knob"), std::runtime_error);
}

}  // namespace gearshift
