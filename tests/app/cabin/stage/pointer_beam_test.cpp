#include "app/cabin/stage/pointer_beam.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

struct PointingCabin {
  cabin::Stage stage;

  explicit PointingCabin(cabin::DriveSide side) : stage(config_for(side), GEARSHIFT_ASSETS "/models") {}

  static cabin::StageConfig config_for(cabin::DriveSide side) {
    cabin::StageConfig config;
    config.gate = paper_gate();
    config.drive = side;
    return config;
  }

  const engine::NodeState& state_of(const char* name) const {
    return stage.scene().nodes[static_cast<std::size_t>(cabin::required_node(stage.model(), name))];
  }

  void point(const std::optional<cabin::Beam>& beam) {
    cabin::StageInput input;
    input.pointer = beam;
    stage.place(input);
  }
};

// [m] The extent of a node's drawn vertices along the beam, measured from the beam's start, and their largest distance
// from the beam's axis.
struct Extent {
  double before = 1e9, beyond = -1e9, aside = 0.0;
};

Extent extent_of(const PointingCabin& cabin, const char* name, const cabin::Beam& beam) {
  const glm::dvec3 along = glm::normalize(beam.to - beam.from);
  Extent extent;
  const engine::Model& model = cabin.stage.model();
  for (const cabin::MeshPart& part :
       cabin::transformed_parts(model, cabin::required_node(model, name), cabin.state_of(name).world)) {
    for (const engine::Vertex& vertex : part.mesh_data.vertices) {
      const glm::dvec3 off = glm::dvec3(vertex.position) - beam.from;
      const double at = glm::dot(off, along);
      extent.before = std::min(extent.before, at);
      extent.beyond = std::max(extent.beyond, at);
      extent.aside = std::max(extent.aside, glm::length(off - at * along));
    }
  }
  return extent;
}

}  // namespace

TEST_CASE("a pointer's beam goes from the hand to its target and ends in a ball") {
  for (const cabin::DriveSide side : {cabin::DriveSide::left, cabin::DriveSide::right}) {
    PointingCabin cabin(side);
    for (const cabin::Beam& beam :
         {cabin::Beam{{0.2, 0.3, -0.1}, {0.335, 0.25, -0.6}}, cabin::Beam{{0.1, 0.2, 0.0}, {0.1, 0.2, 3.0}},
          cabin::Beam{{0.0, 0.4, 0.0}, {0.0, 0.4, -0.5}}, cabin::Beam{{0.6, 0.1, 0.2}, {0.6, 0.9, 0.2}}}) {
      cabin.point(beam);
      REQUIRE(cabin.state_of(cabin::kBeamNode).visible);
      REQUIRE(cabin.state_of(cabin::kBeamEndNode).visible);
      const glm::dmat4 stick(cabin.state_of(cabin::kBeamNode).world);
      CHECK(glm::distance(glm::dvec3(stick[3]), beam.from) < 1e-5);
      CHECK(glm::distance(glm::dvec3(stick * glm::dvec4(0.0, 0.0, -1.0, 1.0)), beam.to) < 1e-5);
      CHECK(glm::distance(glm::dvec3(cabin.state_of(cabin::kBeamEndNode).world[3]), beam.to) < 1e-5);

      const double length = glm::distance(beam.from, beam.to);
      const Extent drawn = extent_of(cabin, cabin::kBeamNode, beam), end = extent_of(cabin, cabin::kBeamEndNode, beam);
      CHECK(std::abs(drawn.before) < 1e-5);
      CHECK(std::abs(drawn.beyond - length) < 1e-5);
      CHECK(drawn.aside == doctest::Approx(0.002).epsilon(0.01));
      CHECK(end.beyond - end.before < 0.008 + 1e-5);
      CHECK(end.aside < 0.004 + 1e-5);
    }
  }
}

TEST_CASE("without a pointer there is no beam; a beam of length zero has only its end; neither part casts a shadow") {
  PointingCabin cabin(cabin::DriveSide::left);
  cabin.point(std::nullopt);
  CHECK_FALSE(cabin.state_of(cabin::kBeamNode).visible);
  CHECK_FALSE(cabin.state_of(cabin::kBeamEndNode).visible);
  cabin.point(cabin::Beam{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}});
  CHECK_FALSE(cabin.state_of(cabin::kBeamNode).visible);
  CHECK(cabin.state_of(cabin::kBeamEndNode).visible);
  CHECK(cabin.state_of(cabin::kBeamNode).opacity < 1.0f);  // blended, so the renderer draws no shadow for it
  CHECK(cabin.state_of(cabin::kBeamEndNode).opacity < 1.0f);
}

}  // namespace gearshift::test
