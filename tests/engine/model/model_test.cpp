// Node poses of a model, and skinned vertices.
#include "engine/model/model.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/model/skin.h"

using namespace gearshift::engine;
using glm::mat4;
using glm::vec3;
using glm::vec4;

namespace {

double distance(const mat4& a, const mat4& b) {
  double worst = 0.0;
  for (int c = 0; c < 4; ++c) worst = std::max(worst, static_cast<double>(glm::distance(a[c], b[c])));
  return worst;
}

Node random_node(std::mt19937& random, int parent) {
  std::uniform_real_distribution<float> number(-1.0f, 1.0f);
  Node node;
  node.parent = parent;
  node.translation = {number(random), number(random), number(random)};
  node.rotation = glm::normalize(glm::quat(number(random), number(random), number(random), number(random)));
  node.scale = {1.0f + 0.2f * number(random), 1.0f + 0.2f * number(random), 1.0f + 0.2f * number(random)};
  return node;
}

}  // namespace

TEST_CASE("a node's matrix scales, then rotates, then translates") {
  Node node;
  node.translation = {1, 2, 3};
  node.rotation = glm::angleAxis(std::acos(0.0f), vec3(0, 0, 1));
  node.scale = {2, 3, 4};
  const vec4 moved = node.local() * vec4(1, 1, 1, 1);  // scaled: (2, 3, 4); rotated: (-3, 2, 4); moved: (-2, 4, 7)
  CHECK(glm::distance(moved, vec4(-2, 4, 7, 1)) < 1e-5f);
}

TEST_CASE("the rest pose of a tree is the product of the matrices up to its root") {
  std::mt19937 random(3);
  Model model;
  for (int i = 0; i < 40; ++i) {
    model.nodes.push_back(
        random_node(random, i == 0 ? kNone : static_cast<int>(random() % static_cast<unsigned>(i + 1)) - 1));
  }
  const std::vector<mat4> world = rest_pose(model);
  std::vector<mat4> local;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    mat4 product = model.nodes[i].local();
    for (int up = model.nodes[i].parent; up != kNone; up = model.nodes[static_cast<std::size_t>(up)].parent) {
      product = model.nodes[static_cast<std::size_t>(up)].local() * product;
    }
    CHECK(distance(world[i], product) < 1e-5);
    local.push_back(model.nodes[i].local());
  }
  local[0] = glm::translate(mat4(1), vec3(5, 0, 0)) * local[0];
  const std::vector<mat4> shifted = world_from_local(model, local);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    int root = static_cast<int>(i);
    while (model.nodes[static_cast<std::size_t>(root)].parent != kNone)
      root = model.nodes[static_cast<std::size_t>(root)].parent;
    const vec4 step = root == 0 ? vec4(5, 0, 0, 0) : vec4(0);
    CHECK(glm::distance(shifted[i][3], world[i][3] + step) < 1e-5f);
  }
  CHECK_THROWS_AS(world_from_local(model, {}), std::invalid_argument);
}

TEST_CASE("two joints bend an arm as calculated by hand: the far half turns, the elbow is the mean") {
  // An arm of length 2 along x; joint 0 at the shoulder, joint 1 at x = 1, rotated by 90 degrees about z.
  Model model;
  model.nodes.resize(3);
  model.nodes[0].mesh = 0;
  model.nodes[0].skin = 0;
  model.nodes[0].translation = {7, 7, 7};  // has no effect, because joints place a skinned mesh
  model.nodes[2].parent = 1;
  model.nodes[2].translation = {1, 0, 0};
  model.nodes[2].rotation = glm::angleAxis(std::acos(0.0f), vec3(0, 0, 1));
  model.skins.push_back({{1, 2}, {mat4(1), glm::translate(mat4(1), vec3(-1, 0, 0))}});
  const float xs[] = {99.0f, 0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 1.5f};
  for (const float x : xs) {  // the first vertex belongs to another mesh
    Vertex v;
    v.position = {x, 0, 0};
    v.normal = {0, 1, 0};
    v.tangent = {1, 0, 0, -1};
    v.uv0 = {x, 0.5f};
    model.vertices.push_back(v);
    VertexJoints joints;
    joints.joint[0] = x <= 1.0f ? 0 : 1;
    model.vertex_joints.push_back(joints);
  }
  VertexJoints& half = model.vertex_joints.back();
  half.joint[1] = 0;
  half.weight[0] = half.weight[1] = 0.5f;
  model.meshes.push_back({"arm", {}, 1, 6});

  std::vector<Vertex> out;
  skin_vertices(model, 0, rest_pose(model), out);
  const vec3 expected[] = {{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {1, 0.5f, 0}, {1, 1, 0}, {1.25f, 0.25f, 0}};
  REQUIRE(out.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(glm::distance(out[i].position, expected[i]) < 1e-6f);
  CHECK(glm::distance(out[0].normal, vec3(0, 1, 0)) < 1e-6f);
  CHECK(glm::distance(out[4].normal, vec3(-1, 0, 0)) < 1e-6f);
  CHECK(glm::distance(out[4].tangent, vec4(0, 1, 0, -1)) < 1e-6f);
  const float diagonal = std::sqrt(0.5f);
  CHECK(glm::distance(out[5].normal, vec3(-diagonal, diagonal, 0)) < 1e-6f);
  CHECK(out[4].uv0 == model.vertices[5].uv0);

  // The model is in its bind pose and moved as a whole, so all vertices move by the same amount.
  model.nodes[2].rotation = glm::quat(1, 0, 0, 0);
  model.nodes[1].translation = {0, 0, 4};
  skin_vertices(model, 0, rest_pose(model), out);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(glm::distance(out[i].position, model.vertices[i + 1].position + vec3(0, 0, 4)) < 1e-6f);
  }
}
