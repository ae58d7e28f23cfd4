#include "app/cabin/stage/stage.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/model/gltf.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr const char* kModels = GEARSHIFT_ASSETS "/models";
constexpr glm::dvec3 kPivot{0.330, 0.007, -0.270};  // [m] the lever's pivot, from the cabin model's README

cabin::StageConfig config_of(const std::string& gate) {
  cabin::StageConfig config;
  config.gate = shipped_gate(gate);
  return config;
}

const cabin::Stage& paper_stage() {
  static const cabin::Stage stage(config_of("paper"), kModels);
  return stage;
}

glm::mat4 world_of(const cabin::Stage& stage, const char* name) {
  const int node = stage.model().node(name);
  REQUIRE(node != engine::kNone);
  return stage.scene().nodes[static_cast<std::size_t>(node)].world;
}

glm::dvec3 position_of(const cabin::Stage& stage, const char* name) {
  return glm::dvec3(world_of(stage, name)[3]);
}

const engine::NodeState& state_of(const cabin::Stage& stage, const char* name) {
  return stage.scene().nodes[static_cast<std::size_t>(stage.model().node(name))];
}

// The knob's position: straight above gate point `p`, on the sphere of radius 0.12 m about the pivot. Computed without
// joint angles.
glm::dvec3 knob_above(glm::dvec2 p) {
  return kPivot + glm::dvec3(p.x, std::sqrt(0.12 * 0.12 - p.x * p.x - p.y * p.y), -p.y);
}

int visible_draws(const cabin::Stage& stage) {
  int draws = 0;
  for (std::size_t i = 0; i < stage.model().nodes.size(); ++i) {
    const int mesh = stage.model().nodes[i].mesh;
    if (mesh == engine::kNone || !stage.scene().nodes[i].visible) continue;
    draws += static_cast<int>(stage.model().meshes[static_cast<std::size_t>(mesh)].primitives.size());
  }
  return draws;
}

}  // namespace

TEST_CASE("with the true lever 15 mm beyond a wall, the drawn knob is within 0.5 mm of the proxy") {
  cabin::Stage stage(config_of("paper"), kModels);
  // The proxy is in first gear, at the left wall of its slot; the true lever is 15 mm further to the left.
  cabin::StageInput input;
  input.lever.proxy = {-0.035, 0.038};
  input.lever.lever = {-0.050, 0.038};
  stage.place(input);
  const glm::dvec3 drawn = position_of(stage, "Knob");
  CHECK(glm::distance(drawn, knob_above(input.lever.proxy)) < 0.0005);
  CHECK(glm::distance(drawn, knob_above(input.lever.proxy)) < 1e-6);
  CHECK(glm::distance(drawn, stage.knob()) < 1e-6);
  CHECK(glm::distance(drawn, knob_above(input.lever.lever)) > 0.014);
  CHECK(glm::distance(stage.ghost_knob(), knob_above(input.lever.lever)) < 1e-6);
}

TEST_CASE("the drawn knob is above the proxy for any position of the lever") {
  cabin::Stage stage(config_of("paper"), kModels);
  std::mt19937_64 dice(5);
  std::uniform_real_distribution<double> x(-0.06, 0.06), y(-0.05, 0.05);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    cabin::StageInput input;
    input.lever.proxy = {x(dice), y(dice)};
    stage.place(input);
    worst = std::max(worst, glm::distance(position_of(stage, "Knob"), knob_above(input.lever.proxy)));
  }
  MESSAGE("worst distance of the drawn knob from the sphere's point: " << 1e6 * worst << " um");
  CHECK(worst < 1e-6);
}

TEST_CASE("the ghost is shown only with the loop's flag, translucent, at the true lever's position") {
  cabin::Stage stage(config_of("paper"), kModels);
  cabin::StageInput input;
  input.lever.proxy = {-0.035, 0.02};
  input.lever.lever = {-0.060, 0.02};
  stage.place(input);
  CHECK_FALSE(state_of(stage, "GhostKnob").visible);
  input.lever.flags = haptics::kFlagGhost;
  stage.place(input);
  CHECK(state_of(stage, "GhostKnob").visible);
  CHECK(state_of(stage, "GhostKnob").opacity < 0.5f);
  CHECK(state_of(stage, "Knob").opacity == 1.0f);
  CHECK(glm::distance(position_of(stage, "GhostKnob"), knob_above(input.lever.lever)) < 1e-6);
}

TEST_CASE("at 4000 rpm the needle points to twelve o'clock of its dial, at 1000 rpm to 101.25 deg left of that") {
  cabin::Stage stage(config_of("paper"), kModels);
  for (const auto& [rpm, left_of_twelve] :
       {std::pair(4000.0, 0.0), std::pair(1000.0, 101.25), std::pair(7000.0, -101.25)}) {
    cabin::StageInput input;
    input.car.engine_speed = rpm * std::numbers::pi / 30.0;
    stage.place(input);
    const glm::mat4 dial = world_of(stage, "TachDial");
    const double angle = left_of_twelve * std::numbers::pi / 180.0;
    const glm::vec4 expected =
        dial * glm::vec4(static_cast<float>(-std::sin(angle)), static_cast<float>(std::cos(angle)), 0.0f, 0.0f);
    const glm::vec4 needle = world_of(stage, "TachNeedle") * glm::vec4(0.0f, 1.0f, 0.0f, 0.0f);
    CHECK(glm::distance(glm::vec3(needle), glm::vec3(expected)) < 1e-5f);
  }
}

TEST_CASE("pedals and handbrake turn in the right direction") {
  cabin::Stage stage(config_of("paper"), kModels);
  cabin::StageInput input;
  stage.place(input);
  const glm::vec4 pad{0.0f, -0.2f, 0.08f, 1.0f}, grip{0.0f, 0.0f, -0.2f, 1.0f};
  const glm::vec4 clutch = world_of(stage, "PedalClutch") * pad;
  const glm::vec4 brake = world_of(stage, "Handbrake") * grip;
  input.car.pedals.clutch = input.car.pedals.hand_brake = 1.0;
  stage.place(input);
  CHECK((world_of(stage, "PedalClutch") * pad).z < clutch.z - 0.03f);  // the pedal's pad moves forward
  CHECK((world_of(stage, "Handbrake") * grip).y > brake.y + 0.05f);    // the handbrake's grip moves up
}

TEST_CASE("the display moves by one field of its atlas per gear") {
  cabin::Stage stage(config_of("paper"), kModels);
  cabin::StageInput input;
  for (int gear = haptics::kReverseGear; gear <= 6; ++gear) {
    input.car.gear = gear;
    stage.place(input);
    CHECK(state_of(stage, "GearPanel").uv_shift.x == doctest::Approx(gear * 176.0 / 2048.0));
    CHECK(state_of(stage, "GearPanel").uv_shift.y == 0.0f);
  }
}

TEST_CASE("a stall shakes needles by at most a few degrees and the lever by about a millimetre, and no camera") {
  cabin::Stage stage(config_of("paper"), kModels);
  cabin::StageInput input;
  input.lever.proxy = {-0.035, 0.038};
  stage.place(input);
  const glm::mat4 needle = world_of(stage, "TachNeedle"), still = world_of(stage, "SteeringWheel");
  double furthest = 0.0, turned = 0.0;
  input.car.shudder = 1.0;
  for (int i = 0; i < 200; ++i) {
    input.time = i / 60.0;
    stage.place(input);
    furthest = std::max(furthest, glm::distance(position_of(stage, "Knob"), knob_above(input.lever.proxy)));
    const glm::vec4 up{0.0f, 1.0f, 0.0f, 0.0f};
    turned = std::max(turned, static_cast<double>(glm::distance(world_of(stage, "TachNeedle") * up, needle * up)));
    REQUIRE(world_of(stage, "SteeringWheel") == still);
    REQUIRE(glm::distance(position_of(stage, "Knob"), stage.knob()) < 1e-6);
    REQUIRE(stage.driver_eye().position == cabin::camera("driver").position);
  }
  MESSAGE("knob " << 1e3 * furthest << " mm, needle " << turned * 180.0 / std::numbers::pi << " deg");
  CHECK(furthest > 0.0003);
  CHECK(furthest < 0.0012);
  CHECK(turned > 0.02);
  CHECK(turned < 0.04);
  input.car.shudder = 0.0;
  stage.place(input);
  CHECK(glm::distance(position_of(stage, "Knob"), knob_above(input.lever.proxy)) < 1e-6);
}

TEST_CASE("a lamp's light is the emission of its node") {
  cabin::Stage stage(config_of("paper"), kModels);
  cabin::StageInput input;
  input.lever.flags = haptics::kFlagOverPush;
  input.car.engine_speed = 100.0;
  stage.place(input);
  CHECK(state_of(stage, "LampLever").emissive == 1.0f);
  CHECK(state_of(stage, "LampOil").emissive == 0.0f);
  input.lever.flags = 0;
  input.car.engine_speed = 0.0;
  stage.place(input);
  CHECK(state_of(stage, "LampLever").emissive == 0.0f);
  CHECK(state_of(stage, "LampOil").emissive == 1.0f);
}

TEST_CASE("without the gearbox, the stage needs at most 64 draws in any state") {
  for (const bool open_gate : {false, true}) {
    cabin::StageConfig config = config_of("six_speed_r_left_up");
    config.open_gate = open_gate;
    cabin::Stage stage(config, kModels);
    const int plain = visible_draws(stage);
    cabin::StageInput pushed;
    pushed.lever.flags = haptics::kFlagGhost;
    pushed.car.shift_advice = 1;
    stage.place(pushed);
    const int with_ghost = visible_draws(stage);
    const std::vector<glm::dvec2> path{{0.0, -0.03}, {0.0, 0.03}};
    pushed.driven_path = pushed.ideal_path = path;
    stage.place(pushed);
    MESSAGE(std::string(open_gate ? "open gate: " : "boot: ")
            << plain << " draws, with ghost and shift light " << with_ghost << ", with the ways too "
            << visible_draws(stage) << ", " << stage.model().triangle_count() << " triangles");
    CHECK(with_ghost > plain);
    CHECK(with_ghost <= 64);
    CHECK(visible_draws(stage) <= 64);
  }
  cabin::StageConfig config = config_of("six_speed_r_left_up");
  config.cutaway = true;
  const cabin::Stage stage(config, kModels);
  MESSAGE("with the gearbox: " << visible_draws(stage) << " draws, " << stage.model().triangle_count() << " triangles");
}

TEST_CASE("every shipped gate gives a valid stage, with the gate open or covered by the boot") {
  for (const std::string& name : shipped_names()) {
    for (const bool open_gate : {false, true}) {
      cabin::StageConfig config = config_of(name);
      config.open_gate = open_gate;
      cabin::Stage stage(config, kModels);
      stage.place({});
      CHECK((stage.model().node("GateInsert") != engine::kNone) == open_gate);
      for (const engine::NodeState& node : stage.scene().nodes) CHECK(std::isfinite(node.world[3].x));
    }
  }
}

TEST_CASE("cameras have names, and an unknown name's error lists them all") {
  for (const char* name : {"driver", "ahead", "lever", "gate", "cluster", "gearbox"}) {
    CHECK(glm::length(cabin::camera(name).orientation) == doctest::Approx(1.0));
  }
  CHECK(glm::distance(cabin::camera("driver").position, glm::dvec3(0.0, 0.635, 0.05)) < 1e-12);
  CHECK(glm::distance(paper_stage().driver_eye().position, cabin::camera("driver").position) == 0.0);
  CHECK_THROWS_WITH_AS(cabin::camera("roof"),
                       "no camera is named 'roof'; choose one of driver, ahead, lever, gate, cluster, gearbox",
                       std::invalid_argument);
}

TEST_CASE(
    "the driver camera's centre square contains road, instruments, knob and gate, the ahead camera's the mirror") {
  const auto in_middle = [](const char* name, glm::dvec3 point) {
    const double fov = cabin::camera_field(name) * std::numbers::pi / 180.0;
    const engine::View view = engine::view_from(cabin::camera(name), engine::symmetric_fov(fov, 16.0 / 9.0), 0.05);
    const glm::dvec3 at = engine::project(view, point, {1280.0, 720.0});
    // The area that the panel leaves free in a window of 1280 x 720 px.
    return at.z > 0.0 && at.x > 320.0 && at.x < 960.0 && at.y > 0.0 && at.y < 652.0;
  };
  const glm::dvec3 horizon = cabin::camera("driver").position + glm::dvec3(0.0, 0.0, -1e4);
  const glm::dvec3 tach = position_of(paper_stage(), "TachDial"), speed = position_of(paper_stage(), "SpeedDial");
  for (const glm::dvec3 point : {horizon, tach, speed, paper_stage().knob(), kPivot + glm::dvec3(0.049, 0.03, 0.053),
                                 kPivot + glm::dvec3(-0.049, 0.03, -0.053)})
    CHECK(in_middle("driver", point));
  for (const glm::dvec3 point : {horizon, tach, speed, position_of(paper_stage(), "InteriorMirrorSurface")})
    CHECK(in_middle("ahead", point));
  // In the driver camera's view the interior mirror is outside the free area, so a second camera ("ahead") shows it.
  CHECK_FALSE(in_middle("driver", position_of(paper_stage(), "InteriorMirrorSurface")));
}

TEST_CASE("a folder without models is rejected with a sentence") {
  CHECK_THROWS_AS(cabin::Stage(config_of("paper"), kModels + std::string("/nowhere")), engine::GltfError);
}

TEST_CASE("reports the cost of placing a frame of the stage") {
  cabin::StageConfig config = config_of("paper");
  config.cutaway = true;
  const auto begin = std::chrono::steady_clock::now();
  cabin::Stage stage(config, kModels);
  const auto ready = std::chrono::steady_clock::now();
  cabin::StageInput input;
  constexpr int kFrames = 200;
  for (int i = 0; i < kFrames; ++i) {
    input.lever.proxy = {0.03 * std::sin(0.1 * i), 0.03 * std::cos(0.1 * i)};
    input.car.distance = 0.3 * i;
    input.time = 0.016 * i;
    stage.place(input);
  }
  const std::chrono::duration<double> load = ready - begin, placed = std::chrono::steady_clock::now() - ready;
  MESSAGE("built in " << 1e3 * load.count() << " ms; a frame placed in " << 1e6 * placed.count() / kFrames << " us");
  CHECK(std::isfinite(stage.knob().x));
}

}  // namespace gearshift::test
