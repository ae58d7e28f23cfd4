#include "app/stage/pointer_beam.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/stage/pieces.h"
#include "app/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift {
namespace {

struct PointingCabin {
  Stage stage;

  explicit PointingCabin(DriveSide side) : stage(config_for(side), GEARSHIFT_ASSETS "/models") {}

  static StageConfig config_for(DriveSide side) {
    StageConfig config;
    config.gate = paper_gate();
    config.drive = side;
    return config;
  }

  const NodeState& state_of(const char* name) const {
    return stage.scene().nodes[static_cast<std::size_t>(needed_node(stage.model(), name))];
  }

  void point(const std::optional<Beam>& beam) {
    StageInput input;
    input.pointer = beam;
    stage.place(input);
  }
};

// Farthest that the drawn vertices of a node reach past the segment's ends, and from its line. [m]
struct Extent {
  double before = 1e9, beyond = -1e9, aside = 0.0;
};

Extent extent_of(const PointingCabin& cabin, const char* name, const Beam& beam) {
  const glm::dvec3 along = glm::normalize(beam.to - beam.from);
  Extent extent;
  const Model& model = cabin.stage.model();
  for (const Piece& piece : placed_pieces(model, needed_node(model, name), cabin.state_of(name).world)) {
    for (const Vertex& vertex : piece.patch.vertices) {
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

TEST_CASE("a pointer's beam goes from the hand to what it points at, and a ball ends it") {
  for (const DriveSide side : {DriveSide::left, DriveSide::right}) {
    PointingCabin cabin(side);
    for (const Beam& beam : {Beam{{0.2, 0.3, -0.1}, {0.335, 0.25, -0.6}}, Beam{{0.1, 0.2, 0.0}, {0.1, 0.2, 3.0}},
                             Beam{{0.0, 0.4, 0.0}, {0.0, 0.4, -0.5}}, Beam{{0.6, 0.1, 0.2}, {0.6, 0.9, 0.2}}}) {
      cabin.point(beam);
      REQUIRE(cabin.state_of(kBeamNode).visible);
      REQUIRE(cabin.state_of(kBeamEndNode).visible);
      const glm::dmat4 stick(cabin.state_of(kBeamNode).world);
      CHECK(glm::distance(glm::dvec3(stick[3]), beam.from) < 1e-5);
      CHECK(glm::distance(glm::dvec3(stick * glm::dvec4(0.0, 0.0, -1.0, 1.0)), beam.to) < 1e-5);
      CHECK(glm::distance(glm::dvec3(cabin.state_of(kBeamEndNode).world[3]), beam.to) < 1e-5);

      const double length = glm::distance(beam.from, beam.to);
      const Extent drawn = extent_of(cabin, kBeamNode, beam), end = extent_of(cabin, kBeamEndNode, beam);
      CHECK(std::abs(drawn.before) < 1e-5);
      CHECK(std::abs(drawn.beyond - length) < 1e-5);
      CHECK(drawn.aside == doctest::Approx(0.002).epsilon(0.01));
      CHECK(end.beyond - end.before < 0.008 + 1e-5);
      CHECK(end.aside < 0.004 + 1e-5);
    }
  }
}

TEST_CASE("nobody points: no beam; at nothing but itself: an end alone; and light throws no shadow") {
  PointingCabin cabin(DriveSide::left);
  cabin.point(std::nullopt);
  CHECK_FALSE(cabin.state_of(kBeamNode).visible);
  CHECK_FALSE(cabin.state_of(kBeamEndNode).visible);
  cabin.point(Beam{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}});
  CHECK_FALSE(cabin.state_of(kBeamNode).visible);
  CHECK(cabin.state_of(kBeamEndNode).visible);
  CHECK(cabin.state_of(kBeamNode).opacity < 1.0f);  // what is blended is no caster
  CHECK(cabin.state_of(kBeamEndNode).opacity < 1.0f);
}

}  // namespace gearshift
