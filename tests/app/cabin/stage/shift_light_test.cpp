// The shift light shows one arrow or none.
#include "app/cabin/stage/shift_light.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

cabin::Stage& stage() {
  static cabin::Stage shared = [] {
    cabin::StageConfig config;
    config.gate = shipped_gate("paper");
    return cabin::Stage(config, GEARSHIFT_ASSETS "/models");
  }();
  return shared;
}

const engine::NodeState& state_of(const char* name) {
  return stage().scene().nodes[static_cast<std::size_t>(stage().model().node(name))];
}

// The corners of an arrow's triangles in world space.
std::vector<glm::vec3> corners(const char* name) {
  const auto node = static_cast<std::size_t>(stage().model().node(name));
  const engine::Mesh& mesh = stage().model().meshes[static_cast<std::size_t>(stage().model().nodes[node].mesh)];
  std::vector<glm::vec3> out;
  for (std::uint32_t i = 0; i < mesh.primitives.front().index_count; ++i) {
    const std::uint32_t index = stage().model().indices[mesh.primitives.front().first_index + i];
    out.push_back(glm::vec3(state_of(name).world * glm::vec4(stage().model().vertices[index].position, 1.0f)));
  }
  return out;
}

}  // namespace

TEST_CASE("one arrow is shown if there is advice, and none otherwise") {
  for (const int advice : {0, 1, -1, 0}) {
    cabin::StageInput input;
    input.car.shift_advice = advice;
    stage().place(input);
    CHECK(state_of(cabin::kShiftUp).visible == (advice > 0));
    CHECK(state_of(cabin::kShiftDown).visible == (advice < 0));
  }
}

TEST_CASE("the arrows face the driver above the gear display, between the indicators, pointing up or down") {
  const glm::vec3 eye(cabin::camera("driver").position);
  for (const char* name : {cabin::kShiftUp, cabin::kShiftDown}) {
    const std::vector<glm::vec3> at = corners(name);
    for (std::size_t i = 0; i < at.size(); i += 3) {
      const glm::vec3 face = glm::cross(at[i + 1] - at[i], at[i + 2] - at[i]);
      CHECK(glm::dot(glm::normalize(face), glm::normalize(eye - at[i])) > 0.5f);
    }
    for (const glm::vec3 corner : at) {
      CHECK(corner.y > glm::vec3(state_of("GearPanel").world[3]).y + 0.02f);
      CHECK(corner.x > glm::vec3(state_of("LampTurnLeft").world[3]).x + 0.01f);
      CHECK(corner.x < glm::vec3(state_of("LampTurnRight").world[3]).x - 0.01f);
    }
    // Only the corner at the arrow's tip lies on the arrow's centre line; the corner at the opposite end does not.
    const auto lower = [](glm::vec3 a, glm::vec3 b) { return a.y < b.y; };
    const glm::vec3 highest = *std::max_element(at.begin(), at.end(), lower);
    const glm::vec3 lowest = *std::min_element(at.begin(), at.end(), lower);
    const float middle = 0.5f * (at[0].x + at[1].x);
    CHECK((name == cabin::kShiftUp ? highest : lowest).x == doctest::Approx(middle).epsilon(1e-4));
    CHECK((name == cabin::kShiftUp ? lowest : highest).x != doctest::Approx(middle).epsilon(1e-4));
  }
}

TEST_CASE("the up arrow is near the centre of the picture for the cameras driver and cluster") {
  for (const char* name : {"driver", "cluster"}) {
    const engine::View view = engine::view_from(
        cabin::camera(name), engine::symmetric_fov(cabin::camera_field(name) * 3.14159265358979 / 180.0, 16.0 / 9.0),
        0.05);
    for (const glm::vec3 corner : corners(cabin::kShiftUp)) {
      const glm::dvec3 at = engine::project(view, glm::dvec3(corner), {1280.0, 720.0});
      CHECK(at.z > 0.0);
      CHECK(at.x > 320.0);
      CHECK(at.x < 960.0);
      CHECK(at.y > 0.0);
      CHECK(at.y < 652.0);
    }
  }
}

}  // namespace gearshift::test
