// Draws the real cabin with the software driver, for tests that check pictures.
#pragma once

#include <vector>

#include "app/cabin/stage/stage.h"
#include "engine/render/renderer.h"
#include "haptics/gate/gate.h"
#include "tests/support/gates.h"
#include "tests/support/gpu_fixture.h"

namespace gearshift::test {

inline cabin::StageConfig open_gate_cabin() {
  cabin::StageConfig config;
  config.gate = shipped_gate("paper");
  config.open_gate = true;
  config.hand = false;
  return config;
}

// Input for the stage: the lever at rest in the given gear, in a stationary car.
inline cabin::StageInput resting_in(const haptics::Gate& gate, int gear) {
  cabin::StageInput input;
  input.lever.gear = gear;
  input.lever.slot = haptics::slot_of_gear(gate, gear);
  input.lever.proxy = input.lever.lever = haptics::rest_position(gate, gear);
  input.car.gear = gear;
  return input;
}

struct CabinRig {
  explicit CabinRig(const engine::RenderConfig& config, const cabin::StageConfig& cabin = open_gate_cabin())
      : gate(cabin.gate), stage(cabin, GEARSHIFT_ASSETS "/models"), renderer(fixture.gpu(), config) {
    renderer.set_model(stage.model());
  }

  engine::Image picture(const cabin::StageInput& input, const engine::View& view) {
    stage.place(input);
    renderer.draw(stage.scene(), {&view, 1});
    return renderer.read_eye(0);
  }

  haptics::Gate gate;
  GpuFixture fixture;
  cabin::Stage stage;
  engine::Renderer renderer;
};

inline engine::View cabin_view(const engine::EyePose& eye, const engine::RenderConfig& config,
                               double vertical_fov_deg = 40.0, double near_plane = 0.05) {
  const double vertical = vertical_fov_deg * 3.14159265358979 / 180.0;
  return engine::view_from(eye, engine::symmetric_fov(vertical, static_cast<double>(config.width) / config.height),
                           near_plane);
}

}  // namespace gearshift::test
