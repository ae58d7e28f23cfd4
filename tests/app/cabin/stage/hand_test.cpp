#include "app/cabin/stage/hand.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/cabin/stage/lever_pose.h"
#include "engine/model/gltf.h"
#include "engine/model/skin.h"

namespace gearshift::test {
namespace {

constexpr glm::dvec3 kKnob{0.330, 0.127, -0.270};
constexpr glm::dvec3 kElbow = kKnob + glm::dvec3(-0.085, 0.055, 0.325);

struct HandRig {
  engine::Model model;
  std::vector<engine::Node> pose;
  std::vector<glm::mat4> world;
  std::vector<engine::Vertex> skin;

  HandRig() {
    cabin::Hand::add_to(model, engine::read_gltf(GEARSHIFT_ASSETS "/models/hand.glb"), glm::vec3(kKnob));
    pose = model.nodes;
  }

  // Places the hand at a knob above gate point `plane`, computes its skin, and returns the knob's position.
  glm::dvec3 hold(const cabin::Hand& hand, glm::dvec2 plane) {
    const glm::dvec3 knob = kKnob + 0.12 * (cabin::lever_direction({}, plane) - glm::dvec3(0.0, 1.0, 0.0));
    hand.place(knob, cabin::lever_rotation({}, plane), pose);
    std::vector<glm::mat4> local;
    for (const engine::Node& node : pose) local.push_back(node.local());
    world = engine::world_from_local(model, local);
    engine::skin_vertices(model, hand.skin_node(), world, skin);
    return knob;
  }

  glm::mat4 world_of(const char* name) const { return world[static_cast<std::size_t>(model.node(name))]; }
};

constexpr glm::dvec2 kPlaces[] = {{0.0, 0.0}, {-0.03, 0.04}, {0.03, -0.04}, {-0.054, 0.04}, {0.054, -0.05}};

}  // namespace

TEST_CASE("the palm keeps its grip on the knob at any lever position") {
  HandRig rig;
  const cabin::Hand hand(rig.model);
  const glm::dvec3 at_rest = rig.hold(hand, {0.0, 0.0});
  const double hold = glm::distance(at_rest, glm::dvec3(rig.world_of("Palm")[3]));
  for (const glm::dvec2 plane : kPlaces) {
    const glm::dvec3 knob = rig.hold(hand, plane);
    CHECK(std::abs(glm::distance(knob, glm::dvec3(rig.world_of("Palm")[3])) - hold) < 1e-6);
    double nearest = 1.0;
    for (const engine::Vertex& vertex : rig.skin)
      nearest = std::min(nearest, glm::distance(knob, glm::dvec3(vertex.position)));
    CHECK(nearest > 0.015);  // the knob's radius is 24 mm, so the skin is close to its surface
    CHECK(nearest < 0.030);
  }
}

TEST_CASE("the hand leans half as much as the lever") {
  HandRig rig;
  const cabin::Hand hand(rig.model);
  for (const glm::dvec2 plane : kPlaces) {
    rig.hold(hand, plane);
    const glm::vec3 up(rig.world_of("HandRoot")[1]);
    const double lean = std::asin(glm::length(plane) / 0.12);
    CHECK(std::acos(std::min(1.0, static_cast<double>(up.y))) == doctest::Approx(0.5 * lean).epsilon(0.002));
  }
}

TEST_CASE("the forearm points from the wrist to a fixed elbow, and keeps its length") {
  HandRig rig;
  const cabin::Hand hand(rig.model);
  rig.hold(hand, {0.0, 0.0});
  const std::vector<engine::Vertex> rest = rig.skin;
  const glm::dmat4 forearm = glm::dmat4(rig.world_of("Forearm"));
  // The elbow in the frame of the forearm's joint.
  const glm::dvec3 along = glm::dvec3(glm::inverse(forearm) * glm::dvec4(kElbow, 1.0));
  // The vertices that move only with the forearm.
  const int joint_node = rig.model.node("Forearm");
  const engine::Skin& skin = rig.model.skins.front();
  const auto joint = std::find(skin.joints.begin(), skin.joints.end(), joint_node) - skin.joints.begin();
  const engine::Mesh& mesh =
      rig.model.meshes[static_cast<std::size_t>(rig.model.nodes[static_cast<std::size_t>(hand.skin_node())].mesh)];
  std::vector<std::size_t> sleeve;
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    const engine::VertexJoints& joints = rig.model.vertex_joints[mesh.first_vertex + i];
    if (joints.joint[0] == joint && joints.weight[0] > 0.999f) sleeve.push_back(i);
  }
  REQUIRE(sleeve.size() > 100);
  for (const glm::dvec2 plane : kPlaces) {
    rig.hold(hand, plane);
    const glm::dmat4 now = glm::dmat4(rig.world_of("Forearm"));
    const glm::dvec3 pointed = glm::normalize(glm::dmat3(now) * along);
    const glm::dvec3 wanted = glm::normalize(kElbow - glm::dvec3(now[3]));
    CHECK(glm::distance(pointed, wanted) < 1e-5);
    for (std::size_t k = 1; k < sleeve.size(); k += 37) {
      const double before = glm::distance(rest[sleeve[0]].position, rest[sleeve[k]].position);
      const double after = glm::distance(rig.skin[sleeve[0]].position, rig.skin[sleeve[k]].position);
      CHECK(std::abs(after - before) < 1e-5);
    }
  }
}

}  // namespace gearshift::test
