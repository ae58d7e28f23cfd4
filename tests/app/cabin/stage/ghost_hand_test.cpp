// The positions at which the hand and its ghost are drawn.
#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr glm::dvec3 kLeverPivot{0.330, 0.007, -0.270};  // [m] from the cabin model's README

// The knob's position: straight above gate point `p`, on the sphere of radius 0.12 m about the pivot.
glm::dvec3 knob_over(glm::dvec2 p) {
  return kLeverPivot + glm::dvec3(p.x, std::sqrt(0.12 * 0.12 - p.x * p.x - p.y * p.y), -p.y);
}

// The vertices of a node's skin, as drawn.
std::vector<glm::dvec3> drawn_skin(const cabin::Stage& stage, const char* name) {
  const auto node = static_cast<std::size_t>(stage.model().node(name));
  const int mesh = stage.model().nodes[node].mesh;
  const std::vector<engine::DeformedMesh>& deformed = stage.scene().deformed;
  const auto skin =
      std::find_if(deformed.begin(), deformed.end(), [&](const engine::DeformedMesh& d) { return d.mesh == mesh; });
  REQUIRE(skin != deformed.end());
  std::vector<glm::dvec3> points;
  for (const engine::Vertex& vertex : skin->vertices)
    points.push_back(glm::dvec3(stage.scene().nodes[node].world * glm::vec4(vertex.position, 1.0f)));
  return points;
}

double nearest(const std::vector<glm::dvec3>& points, glm::dvec3 to) {
  double min_distance = 1e9;
  for (const glm::dvec3 point : points) min_distance = std::min(min_distance, glm::distance(point, to));
  return min_distance;
}

}  // namespace

TEST_CASE("the hand holds the drawn knob and its ghost the ghost's knob, as far apart as proxy and true lever") {
  cabin::StageConfig config;
  config.gate = paper_gate();
  cabin::Stage stage(config, GEARSHIFT_ASSETS "/models");
  for (const auto& [proxy, lever] : {std::pair(glm::dvec2(-0.035, 0.020), glm::dvec2(-0.060, 0.020)),
                                     {{0.0, 0.0}, {0.0, 0.025}},
                                     {{0.035, -0.040}, {0.050, -0.060}}}) {
    cabin::StageInput input;
    input.lever.proxy = proxy;
    input.lever.lever = lever;
    input.lever.flags = haptics::kFlagGhost;
    stage.place(input);
    const std::vector<glm::dvec3> hand = drawn_skin(stage, "HandMesh"), ghost = drawn_skin(stage, "GhostHand");
    const glm::dvec3 knob = knob_over(proxy), ghost_knob = knob_over(lever);
    // The skin's nearest point is close to the knob's surface, 24 mm from the knob's centre.
    CHECK(nearest(hand, knob) > 0.015);
    CHECK(nearest(hand, knob) < 0.030);
    CHECK(nearest(ghost, ghost_knob) == doctest::Approx(nearest(hand, knob)).epsilon(1e-3));
    REQUIRE(ghost.size() == hand.size());
    for (std::size_t i = 0; i < hand.size(); i += 97)
      CHECK(glm::distance(ghost[i] - hand[i], ghost_knob - knob) < 1e-5);
  }
}

TEST_CASE("the ghost's hand is visible only with the loop's flag, and is as transparent as the ghost's knob") {
  cabin::StageConfig config;
  config.gate = paper_gate();
  cabin::Stage stage(config, GEARSHIFT_ASSETS "/models");
  const auto state = [&](const char* name) -> const engine::NodeState& {
    return stage.scene().nodes[static_cast<std::size_t>(stage.model().node(name))];
  };
  cabin::StageInput input;
  input.lever.lever = {0.03, 0.0};
  stage.place(input);
  CHECK_FALSE(state("GhostHand").visible);
  input.lever.flags = haptics::kFlagGhost;
  stage.place(input);
  CHECK(state("GhostHand").visible);
  CHECK(state("GhostHand").opacity == state("GhostKnob").opacity);
  CHECK(state("GhostHand").opacity < 0.5f);
  CHECK(state("HandMesh").opacity == 1.0f);
}

}  // namespace gearshift::test
