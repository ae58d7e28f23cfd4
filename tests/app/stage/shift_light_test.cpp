// The shift light: one arrow, or none.
#include "app/stage/shift_light.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/stage/stage.h"
#include "tests/support/gates.h"

namespace gearshift {
namespace {

Stage& stage() {
  static Stage made = [] {
    StageConfig config;
    config.gate = shipped_gate("paper");
    return Stage(config, GEARSHIFT_ASSETS "/models");
  }();
  return made;
}

const NodeState& state_of(const char* name) {
  return stage().scene().nodes[static_cast<std::size_t>(stage().model().node(name))];
}

// Corners of an arrow in the world.
std::vector<glm::vec3> corners(const char* name) {
  const auto node = static_cast<std::size_t>(stage().model().node(name));
  const Mesh& mesh = stage().model().meshes[static_cast<std::size_t>(stage().model().nodes[node].mesh)];
  std::vector<glm::vec3> out;
  for (std::uint32_t i = 0; i < mesh.primitives.front().index_count; ++i) {
    const std::uint32_t index = stage().model().indices[mesh.primitives.front().first_index + i];
    out.push_back(glm::vec3(state_of(name).world * glm::vec4(stage().model().vertices[index].position, 1.0f)));
  }
  return out;
}

}  // namespace

TEST_CASE("one arrow burns where there is advice, and none is drawn where there is not") {
  for (const int advice : {0, 1, -1, 0}) {
    StageInput input;
    input.car.shift_advice = advice;
    stage().place(input);
    CHECK(state_of(kShiftUp).visible == (advice > 0));
    CHECK(state_of(kShiftDown).visible == (advice < 0));
  }
}

TEST_CASE("the arrows face the driver above the gear display, between the indicators, the point up or down") {
  const glm::vec3 eye(camera("driver").position);
  for (const char* name : {kShiftUp, kShiftDown}) {
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
    // The widest corners are the head's; the point lies beyond them, its way.
    const auto lower = [](glm::vec3 a, glm::vec3 b) { return a.y < b.y; };
    const glm::vec3 highest = *std::max_element(at.begin(), at.end(), lower);
    const glm::vec3 lowest = *std::min_element(at.begin(), at.end(), lower);
    const float middle = 0.5f * (at[0].x + at[1].x);
    CHECK((name == kShiftUp ? highest : lowest).x == doctest::Approx(middle).epsilon(1e-4));
    CHECK((name == kShiftUp ? lowest : highest).x != doctest::Approx(middle).epsilon(1e-4));
  }
}

TEST_CASE("both are seen by the cameras driver and cluster") {
  for (const char* name : {"driver", "cluster"}) {
    const View view =
        view_from(camera(name), symmetric_fov(camera_field(name) * 3.14159265358979 / 180.0, 16.0 / 9.0), 0.05);
    for (const glm::vec3 corner : corners(kShiftUp)) {
      const glm::dvec3 at = project(view, glm::dvec3(corner), {1280.0, 720.0});
      CHECK(at.z > 0.0);
      CHECK(at.x > 320.0);
      CHECK(at.x < 960.0);
      CHECK(at.y > 0.0);
      CHECK(at.y < 652.0);
    }
  }
}

}  // namespace gearshift
