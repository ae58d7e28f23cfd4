// The driver's view in the door mirrors.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// `at` is a point of the mirror's glass; `on` is the direction into which the driver's line of sight is reflected
// there.
struct Glance {
  glm::dvec3 at, on;
};

// The driver's lines of sight in one mirror. `side` is -1 for the left mirror and +1 for the right one.
std::vector<Glance> glances(double side) {
  cabin::StageConfig config;
  config.gate = shipped_gate("paper");
  config.hand = false;
  const cabin::Stage stage(config, GEARSHIFT_ASSETS "/models");
  const glm::dvec3 eye = cabin::camera("driver").position;
  std::vector<Glance> all;
  const int glass = cabin::required_material(stage.model(), "Mirror");
  for (const cabin::MeshPart& part : cabin::parts_of(stage.model(), cabin::required_node(stage.model(), "Bodywork"))) {
    if (part.material != glass) continue;
    for (const engine::Vertex& vertex : part.mesh_data.vertices) {
      const glm::dvec3 at(vertex.position), look = glm::normalize(at - eye);
      if (side * (at.x - 0.335) > 0.0) all.push_back({at, glm::reflect(look, glm::dvec3(vertex.normal))});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("a door mirror shows the horizon in its upper half, the road below, and in its outer part the surroundings") {
  for (const double side : {-1.0, 1.0}) {
    CAPTURE(side);
    const std::vector<Glance> all = glances(side);
    REQUIRE(all.size() > 20);
    const auto by_height = [](const Glance& a, const Glance& b) { return a.at.y < b.at.y; };
    const auto [low, high] = std::minmax_element(all.begin(), all.end(), by_height);
    const double down = std::asin(low->on.y) / kDegree, up = std::asin(high->on.y) / kDegree;
    MESSAGE(std::string(side < 0.0 ? "left: " : "right: ") << down << " to " << up << " deg");
    CHECK(down < -8.0);
    CHECK(up > 1.0);
    CHECK(up < -down);
    for (const Glance& glance : all) CHECK(glance.on.z > 0.8);  // backwards
    const auto by_side = [side](const Glance& a, const Glance& b) { return side * a.at.x < side * b.at.x; };
    const auto [inner, outer] = std::minmax_element(all.begin(), all.end(), by_side);
    CHECK(side * outer->on.x > side * inner->on.x + 0.1);
  }
}

}  // namespace gearshift::test
