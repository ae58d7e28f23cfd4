// The lever paths drawn above the gate, compared with the sphere on which the knob moves.
#include "app/cabin/stage/path_ribbon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr glm::dvec3 kWayPivot{0.330, 0.007, -0.270};  // [m] the lever's pivot, from the cabin model's README
// [m] The radius of the knob's sphere plus the height at which the paths are drawn above it.
constexpr double kSphere = 0.120 + 0.026;

// The point straight above gate point `p` on the knob's sphere, scaled to the sphere of the drawn paths. Computed
// without joint angles.
glm::dvec3 above_knob(glm::dvec2 p) {
  const glm::dvec3 knob{p.x, std::sqrt(0.12 * 0.12 - p.x * p.x - p.y * p.y), -p.y};
  return kSphere / 0.12 * knob;
}

glm::dvec3 side_of(const std::vector<engine::Vertex>& tube, int ring, int side) {
  const int at = ring * cabin::kPathSides + side;
  return glm::dvec3(tube[static_cast<std::size_t>(at)].position);
}

glm::dvec3 middle_of(const std::vector<engine::Vertex>& tube, int ring) {
  glm::dvec3 sum{0.0};
  for (int side = 0; side < cabin::kPathSides; ++side) sum += side_of(tube, ring, side);
  return sum / static_cast<double>(cabin::kPathSides);
}

double radius_of(const std::vector<engine::Vertex>& tube, int ring) {
  return glm::distance(side_of(tube, ring, 0), middle_of(tube, ring));
}

const engine::NodeState& path_state(const cabin::Stage& stage, const char* name) {
  return stage.scene().nodes[static_cast<std::size_t>(stage.model().node(name))];
}

cabin::Stage stage_of_paper() {
  cabin::StageConfig config;
  config.gate = shipped_gate("paper");
  return cabin::Stage(config, GEARSHIFT_ASSETS "/models");
}

}  // namespace

TEST_CASE("from second to third (106 mm), ring i is above the path's point at i / 319 of its length") {
  // The path is 40 + 26 + 40 = 106 mm long.
  const std::vector<glm::dvec2> path{{-0.01, -0.04}, {-0.01, 0.0}, {0.016, 0.0}, {0.016, 0.04}};
  std::vector<engine::Vertex> tube;
  REQUIRE(cabin::shape_path(path, haptics::YokeGeometry{}, cabin::kDrivenStyle, tube));
  REQUIRE(tube.size() == static_cast<std::size_t>(cabin::kPathRings * cabin::kPathSides));
  double worst = 0.0;
  for (int i = 0; i < cabin::kPathRings; ++i) {
    const double s = 0.106 * i / 319.0;
    const glm::dvec2 p = s < 0.040   ? glm::dvec2(-0.01, -0.04 + s)
                         : s < 0.066 ? glm::dvec2(-0.01 + s - 0.040, 0.0)
                                     : glm::dvec2(0.016, s - 0.066);
    worst = std::max(worst, glm::distance(middle_of(tube, i), above_knob(p)));
  }
  MESSAGE("furthest from the sphere: " << 1e6 * worst << " um");
  CHECK(worst < 1e-6);
  for (const int ring : {1, 100, 150, 318})
    CHECK(radius_of(tube, ring) == doctest::Approx(cabin::kDrivenStyle.radius).epsilon(1e-3));
  for (const int ring : {0, 319}) CHECK(radius_of(tube, ring) < 1e-7);
}

TEST_CASE("the faces of a path are oriented outwards") {
  const std::vector<glm::dvec2> path{{-0.03, 0.0}, {0.03, 0.01}};
  engine::Model model;
  cabin::add_path(model, "Way", glm::vec3(0.0f), cabin::kDrivenStyle);
  std::vector<engine::Vertex> tube;
  REQUIRE(cabin::shape_path(path, haptics::YokeGeometry{}, cabin::kDrivenStyle, tube));
  for (std::size_t i = 0; i < model.indices.size(); i += 3) {
    const engine::Vertex& a = tube[model.indices[i]];
    const engine::Vertex& b = tube[model.indices[i + 1]];
    const engine::Vertex& c = tube[model.indices[i + 2]];
    const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
    CHECK(glm::dot(face, a.normal + b.normal + c.normal) >= -1e-12f);
  }
}

TEST_CASE("a dashed path has dashes of 4 mm and gaps of 4 mm, and begins with a dash") {
  std::vector<engine::Vertex> tube;
  REQUIRE(cabin::shape_path(std::vector<glm::dvec2>{{-0.04, 0.0}, {0.04, 0.0}}, haptics::YokeGeometry{},
                            cabin::kIdealStyle, tube));
  for (int i = 1; i < cabin::kPathRings - 1; ++i) {
    const double along = 0.080 * i / 319.0, in_period = std::fmod(along, 0.008);
    CAPTURE(along);
    if (in_period < 0.0039) CHECK(radius_of(tube, i) > 0.001);
    if (in_period > 0.0041) CHECK(radius_of(tube, i) < 1e-7);
  }
}

TEST_CASE("nothing is drawn for paths without length: no point, one point, a repeated point, non-finite points") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<engine::Vertex> tube;
  CHECK_FALSE(cabin::shape_path({}, haptics::YokeGeometry{}, cabin::kDrivenStyle, tube));
  CHECK_FALSE(
      cabin::shape_path(std::vector<glm::dvec2>{{0.01, 0.0}}, haptics::YokeGeometry{}, cabin::kDrivenStyle, tube));
  CHECK_FALSE(
      cabin::shape_path(std::vector<glm::dvec2>(50, {0.01, 0.0}), haptics::YokeGeometry{}, cabin::kDrivenStyle, tube));
  CHECK_FALSE(cabin::shape_path(std::vector<glm::dvec2>{{nan, 0.0}, {0.0, nan}}, haptics::YokeGeometry{},
                                cabin::kDrivenStyle, tube));
  CHECK(tube.empty());
  REQUIRE(cabin::shape_path(std::vector<glm::dvec2>{{0.0, 0.0}, {nan, 0.0}, {0.0, 0.03}, {0.0, 0.0}, {5.0, 5.0}},
                            haptics::YokeGeometry{}, cabin::kDrivenStyle,
                            tube));  // this path contains NaN, turns back and leaves the yoke's reach
  for (const engine::Vertex& vertex : tube) {
    REQUIRE(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
    REQUIRE(glm::length(vertex.normal) == doctest::Approx(1.0).epsilon(1e-4));
  }
}

TEST_CASE("the stage shows paths only while they are in its input, at the lever's pivot, with a transparent hand") {
  cabin::Stage stage = stage_of_paper();
  const std::size_t deformed = stage.scene().deformed.size();
  CHECK_FALSE(path_state(stage, cabin::kDrivenPath).visible);
  CHECK_FALSE(path_state(stage, cabin::kIdealPath).visible);
  CHECK(path_state(stage, "HandMesh").opacity == 1.0f);

  std::vector<glm::dvec2> driven, ideal{{0.0, -0.03}, {0.0, 0.03}};
  for (int i = 0; i <= 400; ++i) driven.push_back({0.004 * std::sin(0.05 * i), -0.03 + 0.00015 * i});
  cabin::StageInput input;
  input.driven_path = driven;
  stage.place(input);
  CHECK(path_state(stage, cabin::kDrivenPath).visible);
  CHECK_FALSE(path_state(stage, cabin::kIdealPath).visible);
  CHECK(path_state(stage, "HandMesh").opacity < 0.5f);
  REQUIRE(stage.scene().deformed.size() == deformed + 1);
  const engine::DeformedMesh& shape = stage.scene().deformed.back();
  const auto node = static_cast<std::size_t>(stage.model().node(cabin::kDrivenPath));
  REQUIRE(shape.mesh == stage.model().nodes[node].mesh);
  CHECK(shape.vertices.size() == stage.model().meshes[static_cast<std::size_t>(shape.mesh)].vertex_count);
  const glm::dvec3 first = glm::dvec3(path_state(stage, cabin::kDrivenPath).world[3]) + middle_of(shape.vertices, 0);
  CHECK(glm::distance(first, kWayPivot + above_knob(driven.front())) < 1e-6);

  input.ideal_path = ideal;
  stage.place(input);
  CHECK(path_state(stage, cabin::kIdealPath).visible);
  CHECK(stage.scene().deformed.size() == deformed + 2);
  stage.place({});
  CHECK_FALSE(path_state(stage, cabin::kDrivenPath).visible);
  CHECK(stage.scene().deformed.size() == deformed);
  CHECK(path_state(stage, "HandMesh").opacity == 1.0f);
}

TEST_CASE("for the cameras driver, lever and gate, a path from second to third is near the centre of the picture") {
  const haptics::Gate gate = shipped_gate("five_speed_r_right_down");
  for (const char* name : {"driver", "lever", "gate"}) {
    const double fov = cabin::camera_field(name) * 3.14159265358979 / 180.0;
    const engine::View view = engine::view_from(cabin::camera(name), engine::symmetric_fov(fov, 16.0 / 9.0), 0.05);
    for (const int gear : {2, 3}) {
      const glm::dvec3 at =
          engine::project(view, kWayPivot + above_knob(haptics::rest_position(gate, gear)), {1280.0, 720.0});
      CAPTURE(name);
      CHECK(at.z > 0.0);
      CHECK(at.x > 280.0);
      CHECK(at.x < 1000.0);
      CHECK(at.y > 0.0);
      CHECK(at.y < 720.0);
    }
  }
}

}  // namespace gearshift::test
