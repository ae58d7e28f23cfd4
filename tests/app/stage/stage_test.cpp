#include "app/stage/stage.h"

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

namespace gearshift {
namespace {

constexpr const char* kModels = GEARSHIFT_ASSETS "/models";
constexpr glm::dvec3 kPivot{0.330, 0.007, -0.270};  // [m] of the lever, from the cabin's notes

StageConfig config_of(const std::string& gate) {
  StageConfig config;
  config.gate = shipped_gate(gate);
  return config;
}

const Stage& paper_stage() {
  static const Stage stage(config_of("paper"), kModels);
  return stage;
}

glm::mat4 world_of(const Stage& stage, const char* name) {
  const int node = stage.model().node(name);
  REQUIRE(node != kNone);
  return stage.scene().nodes[static_cast<std::size_t>(node)].world;
}

glm::dvec3 place_of(const Stage& stage, const char* name) {
  return glm::dvec3(world_of(stage, name)[3]);
}

const NodeState& state_of(const Stage& stage, const char* name) {
  return stage.scene().nodes[static_cast<std::size_t>(stage.model().node(name))];
}

// On the sphere of 0.12 m about the pivot, straight above the plane point; no joint angle is used.
glm::dvec3 knob_above(glm::dvec2 p) {
  return kPivot + glm::dvec3(p.x, std::sqrt(0.12 * 0.12 - p.x * p.x - p.y * p.y), -p.y);
}

int visible_draws(const Stage& stage) {
  int draws = 0;
  for (std::size_t i = 0; i < stage.model().nodes.size(); ++i) {
    const int mesh = stage.model().nodes[i].mesh;
    if (mesh == kNone || !stage.scene().nodes[i].visible) continue;
    draws += static_cast<int>(stage.model().meshes[static_cast<std::size_t>(mesh)].primitives.size());
  }
  return draws;
}

}  // namespace

TEST_CASE(
    "with the lever point 15 mm through a wall the drawn knob is within 0.5 mm of the proxy, and not of the hand") {
  Stage stage(config_of("paper"), kModels);
  // In first, at the left wall of its slot: the hand is 15 mm further left.
  StageInput input;
  input.lever.proxy = {-0.035, 0.038};
  input.lever.lever = {-0.050, 0.038};
  stage.place(input);
  const glm::dvec3 drawn = place_of(stage, "Knob");
  CHECK(glm::distance(drawn, knob_above(input.lever.proxy)) < 0.0005);
  CHECK(glm::distance(drawn, knob_above(input.lever.proxy)) < 1e-6);
  CHECK(glm::distance(drawn, stage.knob()) < 1e-6);
  CHECK(glm::distance(drawn, knob_above(input.lever.lever)) > 0.014);
  CHECK(glm::distance(stage.ghost_knob(), knob_above(input.lever.lever)) < 1e-6);
}

TEST_CASE("the drawn knob is above the proxy wherever that is") {
  Stage stage(config_of("paper"), kModels);
  std::mt19937_64 dice(5);
  std::uniform_real_distribution<double> x(-0.06, 0.06), y(-0.05, 0.05);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    StageInput input;
    input.lever.proxy = {x(dice), y(dice)};
    stage.place(input);
    worst = std::max(worst, glm::distance(place_of(stage, "Knob"), knob_above(input.lever.proxy)));
  }
  MESSAGE("worst distance of the drawn knob from the sphere's point: " << 1e6 * worst << " um");
  CHECK(worst < 1e-6);
}

TEST_CASE("the ghost is shown past the loop's flag only, translucent, where the hand is") {
  Stage stage(config_of("paper"), kModels);
  StageInput input;
  input.lever.proxy = {-0.035, 0.02};
  input.lever.lever = {-0.060, 0.02};
  stage.place(input);
  CHECK_FALSE(state_of(stage, "GhostKnob").visible);
  input.lever.flags = kFlagGhost;
  stage.place(input);
  CHECK(state_of(stage, "GhostKnob").visible);
  CHECK(state_of(stage, "GhostKnob").opacity < 0.5f);
  CHECK(state_of(stage, "Knob").opacity == 1.0f);
  CHECK(glm::distance(place_of(stage, "GhostKnob"), knob_above(input.lever.lever)) < 1e-6);
}

TEST_CASE("at 4000 rpm the needle points to twelve o'clock of its dial, at 1000 rpm to 101.25 deg left of it") {
  Stage stage(config_of("paper"), kModels);
  for (const auto& [rpm, left_of_twelve] :
       {std::pair(4000.0, 0.0), std::pair(1000.0, 101.25), std::pair(7000.0, -101.25)}) {
    StageInput input;
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

TEST_CASE("wheel, pedals and handbrake turn the way their driver means") {
  Stage stage(config_of("paper"), kModels);
  StageInput input;
  stage.place(input);
  const glm::vec4 top{0.0f, 0.1f, 0.0f, 1.0f}, pad{0.0f, -0.2f, 0.08f, 1.0f}, grip{0.0f, 0.0f, -0.2f, 1.0f};
  const glm::vec4 wheel = world_of(stage, "SteeringWheel") * top, clutch = world_of(stage, "PedalClutch") * pad;
  const glm::vec4 brake = world_of(stage, "Handbrake") * grip;
  input.car.steering = 0.5;
  input.car.clutch = input.car.hand_brake = 1.0;
  stage.place(input);
  CHECK((world_of(stage, "SteeringWheel") * top).x < wheel.x - 0.04f);  // the top goes to the left
  CHECK((world_of(stage, "PedalClutch") * pad).z < clutch.z - 0.03f);   // the pad goes forward
  CHECK((world_of(stage, "Handbrake") * grip).y > brake.y + 0.05f);     // the grip goes up
}

TEST_CASE("the display steps one field of its atlas a gear") {
  Stage stage(config_of("paper"), kModels);
  StageInput input;
  for (int gear = kReverseGear; gear <= 6; ++gear) {
    input.car.gear = gear;
    stage.place(input);
    CHECK(state_of(stage, "GearPanel").uv_shift.x == doctest::Approx(gear * 176.0 / 2048.0));
    CHECK(state_of(stage, "GearPanel").uv_shift.y == 0.0f);
  }
}

TEST_CASE("a stall shakes needles and lever by a few degrees and a millimetre at most, and no camera") {
  Stage stage(config_of("paper"), kModels);
  StageInput input;
  input.lever.proxy = {-0.035, 0.038};
  stage.place(input);
  const glm::mat4 needle = world_of(stage, "TachNeedle"), still = world_of(stage, "SteeringWheel");
  double furthest = 0.0, turned = 0.0;
  input.car.shudder = 1.0;
  for (int i = 0; i < 200; ++i) {
    input.time = i / 60.0;
    stage.place(input);
    furthest = std::max(furthest, glm::distance(place_of(stage, "Knob"), knob_above(input.lever.proxy)));
    const glm::vec4 up{0.0f, 1.0f, 0.0f, 0.0f};
    turned = std::max(turned, static_cast<double>(glm::distance(world_of(stage, "TachNeedle") * up, needle * up)));
    REQUIRE(world_of(stage, "SteeringWheel") == still);
    REQUIRE(glm::distance(place_of(stage, "Knob"), stage.knob()) < 1e-6);
    REQUIRE(stage.driver_eye().position == camera("driver").position);
  }
  MESSAGE("knob " << 1e3 * furthest << " mm, needle " << turned * 180.0 / std::numbers::pi << " deg");
  CHECK(furthest > 0.0003);
  CHECK(furthest < 0.0012);
  CHECK(turned > 0.02);
  CHECK(turned < 0.04);
  input.car.shudder = 0.0;
  stage.place(input);
  CHECK(glm::distance(place_of(stage, "Knob"), knob_above(input.lever.proxy)) < 1e-6);
}

TEST_CASE("a lamp's light is its node's emission") {
  Stage stage(config_of("paper"), kModels);
  StageInput input;
  input.lever.flags = kFlagOverPush;
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

TEST_CASE("the stage is drawn in at most 64 draws, whatever it shows but the gearbox") {
  for (const bool open_gate : {false, true}) {
    StageConfig config = config_of("six_speed_r_left_up");
    config.open_gate = open_gate;
    Stage stage(config, kModels);
    const int alone = visible_draws(stage);
    StageInput pushed;
    pushed.lever.flags = kFlagGhost;
    pushed.car.shift_advice = 1;
    stage.place(pushed);
    const int with_ghost = visible_draws(stage);
    const std::vector<glm::dvec2> way{{0.0, -0.03}, {0.0, 0.03}};
    pushed.driven_way = pushed.ideal_way = way;
    stage.place(pushed);
    MESSAGE(std::string(open_gate ? "open gate: " : "boot: ")
            << alone << " draws, with ghost and shift light " << with_ghost << ", with the ways too "
            << visible_draws(stage) << ", " << stage.model().triangle_count() << " triangles");
    CHECK(with_ghost > alone);
    CHECK(with_ghost <= 64);
    CHECK(visible_draws(stage) <= 64);
  }
  StageConfig config = config_of("six_speed_r_left_up");
  config.cutaway = true;
  const Stage stage(config, kModels);
  MESSAGE("with the gearbox: " << visible_draws(stage) << " draws, " << stage.model().triangle_count() << " triangles");
}

TEST_CASE("every shipped gate makes a stage, open and closed") {
  for (const std::string& name : shipped_names()) {
    for (const bool open_gate : {false, true}) {
      StageConfig config = config_of(name);
      config.open_gate = open_gate;
      Stage stage(config, kModels);
      stage.place({});
      CHECK((stage.model().node("GateInsert") != kNone) == open_gate);
      for (const NodeState& node : stage.scene().nodes) CHECK(std::isfinite(node.world[3].x));
    }
  }
}

TEST_CASE("cameras have names, and an unknown one is told them all") {
  for (const char* name : {"driver", "ahead", "lever", "gate", "cluster", "gearbox"}) {
    CHECK(glm::length(camera(name).orientation) == doctest::Approx(1.0));
  }
  CHECK(glm::distance(camera("driver").position, glm::dvec3(0.0, 0.635, 0.05)) < 1e-12);
  CHECK(glm::distance(paper_stage().driver_eye().position, camera("driver").position) == 0.0);
  CHECK_THROWS_WITH_AS(camera("roof"), "no camera 'roof': there are driver, ahead, lever, gate, cluster, gearbox",
                       std::invalid_argument);
}

TEST_CASE(
    "road, instruments, hand and gate lie in the middle square of the driver's picture, the mirror in the view "
    "ahead's") {
  const auto in_middle = [](const char* name, glm::dvec3 point) {
    const double fov = camera_field(name) * std::numbers::pi / 180.0;
    const View view = view_from(camera(name), symmetric_fov(fov, 16.0 / 9.0), 0.05);
    const glm::dvec3 at = project(view, point, {1280.0, 720.0});
    // What the panel of a window of 1280 x 720 leaves free.
    return at.z > 0.0 && at.x > 320.0 && at.x < 960.0 && at.y > 0.0 && at.y < 652.0;
  };
  const glm::dvec3 horizon = camera("driver").position + glm::dvec3(0.0, 0.0, -1e4);
  const glm::dvec3 tach = place_of(paper_stage(), "TachDial"), speed = place_of(paper_stage(), "SpeedDial");
  for (const glm::dvec3 point : {horizon, tach, speed, paper_stage().knob(), kPivot + glm::dvec3(0.049, 0.03, 0.053),
                                 kPivot + glm::dvec3(-0.049, 0.03, -0.053)})
    CHECK(in_middle("driver", point));
  for (const glm::dvec3 point : {horizon, tach, speed, place_of(paper_stage(), "InteriorMirrorSurface")})
    CHECK(in_middle("ahead", point));
  CHECK_FALSE(in_middle("driver", place_of(paper_stage(), "InteriorMirrorSurface")));  // the reason for two of them
}

TEST_CASE("a folder without models is refused with a sentence") {
  CHECK_THROWS_AS(Stage(config_of("paper"), kModels + std::string("/nowhere")), GltfError);
}

TEST_CASE("what a frame of the stage costs") {
  StageConfig config = config_of("paper");
  config.cutaway = true;
  const auto begin = std::chrono::steady_clock::now();
  Stage stage(config, kModels);
  const auto ready = std::chrono::steady_clock::now();
  StageInput input;
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

}  // namespace gearshift
