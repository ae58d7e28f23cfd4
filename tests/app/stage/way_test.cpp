// The ways over the gate: their points against the sphere that the knob moves on.
#include "app/stage/way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift {
namespace {

constexpr glm::dvec3 kWayPivot{0.330, 0.007, -0.270};  // [m] of the lever, from the cabin's notes
constexpr double kSphere = 0.120 + 0.026;              // [m] knob's centre, and what the ways lie above it

// Straight above the plane point where the knob's sphere is, drawn out to the ways': no joint angle is used.
glm::dvec3 above_knob(glm::dvec2 p) {
  const glm::dvec3 knob{p.x, std::sqrt(0.12 * 0.12 - p.x * p.x - p.y * p.y), -p.y};
  return kSphere / 0.12 * knob;
}

glm::dvec3 side_of(const std::vector<Vertex>& tube, int ring, int side) {
  const int at = ring * kWaySides + side;
  return glm::dvec3(tube[static_cast<std::size_t>(at)].position);
}

glm::dvec3 middle_of(const std::vector<Vertex>& tube, int ring) {
  glm::dvec3 sum{0.0};
  for (int side = 0; side < kWaySides; ++side) sum += side_of(tube, ring, side);
  return sum / static_cast<double>(kWaySides);
}

double radius_of(const std::vector<Vertex>& tube, int ring) {
  return glm::distance(side_of(tube, ring, 0), middle_of(tube, ring));
}

const NodeState& way_state(const Stage& stage, const char* name) {
  return stage.scene().nodes[static_cast<std::size_t>(stage.model().node(name))];
}

Stage stage_of_paper() {
  StageConfig config;
  config.gate = shipped_gate("paper");
  return Stage(config, GEARSHIFT_ASSETS "/models");
}

}  // namespace

TEST_CASE("a way from second to third: ring i lies over the point after i / 319 of its 106 mm, on the knob's sphere") {
  const std::vector<glm::dvec2> way{{-0.01, -0.04}, {-0.01, 0.0}, {0.016, 0.0}, {0.016, 0.04}};  // 40 + 26 + 40 mm
  std::vector<Vertex> tube;
  REQUIRE(shape_way(way, YokeGeometry{}, kDrivenLook, tube));
  REQUIRE(tube.size() == static_cast<std::size_t>(kWayRings * kWaySides));
  double worst = 0.0;
  for (int i = 0; i < kWayRings; ++i) {
    const double s = 0.106 * i / 319.0;
    const glm::dvec2 p = s < 0.040   ? glm::dvec2(-0.01, -0.04 + s)
                         : s < 0.066 ? glm::dvec2(-0.01 + s - 0.040, 0.0)
                                     : glm::dvec2(0.016, s - 0.066);
    worst = std::max(worst, glm::distance(middle_of(tube, i), above_knob(p)));
  }
  MESSAGE("furthest from the sphere: " << 1e6 * worst << " um");
  CHECK(worst < 1e-6);
  for (const int ring : {1, 100, 150, 318})
    CHECK(radius_of(tube, ring) == doctest::Approx(kDrivenLook.radius).epsilon(1e-3));
  for (const int ring : {0, 319}) CHECK(radius_of(tube, ring) < 1e-7);
}

TEST_CASE("its faces look outwards") {
  const std::vector<glm::dvec2> way{{-0.03, 0.0}, {0.03, 0.01}};
  Model model;
  add_way(model, "Way", glm::vec3(0.0f), kDrivenLook);
  std::vector<Vertex> tube;
  REQUIRE(shape_way(way, YokeGeometry{}, kDrivenLook, tube));
  for (std::size_t i = 0; i < model.indices.size(); i += 3) {
    const Vertex& a = tube[model.indices[i]];
    const Vertex& b = tube[model.indices[i + 1]];
    const Vertex& c = tube[model.indices[i + 2]];
    const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
    CHECK(glm::dot(face, a.normal + b.normal + c.normal) >= -1e-12f);
  }
}

TEST_CASE("dashes: 4 mm drawn, 4 mm not, from the beginning on") {
  std::vector<Vertex> tube;
  REQUIRE(shape_way(std::vector<glm::dvec2>{{-0.04, 0.0}, {0.04, 0.0}}, YokeGeometry{}, kIdealLook, tube));
  for (int i = 1; i < kWayRings - 1; ++i) {
    const double along = 0.080 * i / 319.0, in_period = std::fmod(along, 0.008);
    CAPTURE(along);
    if (in_period < 0.0039) CHECK(radius_of(tube, i) > 0.001);
    if (in_period > 0.0041) CHECK(radius_of(tube, i) < 1e-7);
  }
}

TEST_CASE("what has no length is no way: nothing, a point, the same point again, no numbers") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vertex> tube;
  CHECK_FALSE(shape_way({}, YokeGeometry{}, kDrivenLook, tube));
  CHECK_FALSE(shape_way(std::vector<glm::dvec2>{{0.01, 0.0}}, YokeGeometry{}, kDrivenLook, tube));
  CHECK_FALSE(shape_way(std::vector<glm::dvec2>(50, {0.01, 0.0}), YokeGeometry{}, kDrivenLook, tube));
  CHECK_FALSE(shape_way(std::vector<glm::dvec2>{{nan, 0.0}, {0.0, nan}}, YokeGeometry{}, kDrivenLook, tube));
  CHECK(tube.empty());
  REQUIRE(shape_way(std::vector<glm::dvec2>{{0.0, 0.0}, {nan, 0.0}, {0.0, 0.03}, {0.0, 0.0}, {5.0, 5.0}},
                    YokeGeometry{}, kDrivenLook, tube));  // turns back on itself, and leaves the yoke's reach
  for (const Vertex& vertex : tube) {
    REQUIRE(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
    REQUIRE(glm::length(vertex.normal) == doctest::Approx(1.0).epsilon(1e-4));
  }
}

TEST_CASE("the stage shows the ways while it is given them, at the lever's pivot, and the hand is of glass then") {
  Stage stage = stage_of_paper();
  const std::size_t deformed = stage.scene().deformed.size();
  CHECK_FALSE(way_state(stage, kDrivenWay).visible);
  CHECK_FALSE(way_state(stage, kIdealWay).visible);
  CHECK(way_state(stage, "HandMesh").opacity == 1.0f);

  std::vector<glm::dvec2> driven, ideal{{0.0, -0.03}, {0.0, 0.03}};
  for (int i = 0; i <= 400; ++i) driven.push_back({0.004 * std::sin(0.05 * i), -0.03 + 0.00015 * i});
  StageInput input;
  input.driven_way = driven;
  stage.place(input);
  CHECK(way_state(stage, kDrivenWay).visible);
  CHECK_FALSE(way_state(stage, kIdealWay).visible);
  CHECK(way_state(stage, "HandMesh").opacity < 0.5f);
  REQUIRE(stage.scene().deformed.size() == deformed + 1);
  const DeformedMesh& shape = stage.scene().deformed.back();
  const auto node = static_cast<std::size_t>(stage.model().node(kDrivenWay));
  REQUIRE(shape.mesh == stage.model().nodes[node].mesh);
  CHECK(shape.vertices.size() == stage.model().meshes[static_cast<std::size_t>(shape.mesh)].vertex_count);
  const glm::dvec3 first = glm::dvec3(way_state(stage, kDrivenWay).world[3]) + middle_of(shape.vertices, 0);
  CHECK(glm::distance(first, kWayPivot + above_knob(driven.front())) < 1e-6);

  input.ideal_way = ideal;
  stage.place(input);
  CHECK(way_state(stage, kIdealWay).visible);
  CHECK(stage.scene().deformed.size() == deformed + 2);
  stage.place({});
  CHECK_FALSE(way_state(stage, kDrivenWay).visible);
  CHECK(stage.scene().deformed.size() == deformed);
  CHECK(way_state(stage, "HandMesh").opacity == 1.0f);
}

TEST_CASE("from driver, lever and gate a whole way from second to third is in the picture's middle square") {
  const Gate gate = shipped_gate("five_speed_r_right_down");
  for (const char* name : {"driver", "lever", "gate"}) {
    const double fov = camera_field(name) * 3.14159265358979 / 180.0;
    const View view = view_from(camera(name), symmetric_fov(fov, 16.0 / 9.0), 0.05);
    for (const int gear : {2, 3}) {
      const glm::dvec3 at = project(view, kWayPivot + above_knob(rest_position(gate, gear)), {1280.0, 720.0});
      CAPTURE(name);
      CHECK(at.z > 0.0);
      CHECK(at.x > 280.0);
      CHECK(at.x < 1000.0);
      CHECK(at.y > 0.0);
      CHECK(at.y < 720.0);
    }
  }
}

}  // namespace gearshift
