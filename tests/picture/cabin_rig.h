// The real cabin on the software driver, for tests that look at pictures.
#pragma once

#include <vector>

#include "app/stage/stage.h"
#include "engine/render/renderer.h"
#include "haptics/gate/gate.h"
#include "tests/support/gates.h"
#include "tests/support/gpu_fixture.h"

namespace gearshift {

inline StageConfig open_gate_cabin() {
  StageConfig config;
  config.gate = shipped_gate("paper");
  config.open_gate = true;
  config.hand = false;
  return config;
}

// Lever point and drawn lever at rest in that gear, the car standing.
inline StageInput resting_in(const Gate& gate, int gear) {
  StageInput input;
  input.lever.gear = gear;
  input.lever.slot = slot_of_gear(gate, gear);
  input.lever.proxy = input.lever.lever = rest_position(gate, gear);
  input.car.gear = gear;
  return input;
}

struct CabinRig {
  explicit CabinRig(const RenderConfig& config, const StageConfig& cabin = open_gate_cabin())
      : gate(cabin.gate), stage(cabin, GEARSHIFT_ASSETS "/models"), renderer(fixture.gpu(), config) {
    renderer.set_model(stage.model());
  }

  Image picture(const StageInput& input, const View& view) {
    stage.place(input);
    renderer.draw(stage.scene(), {&view, 1});
    return renderer.read_eye(0);
  }

  Gate gate;
  GpuFixture fixture;
  Stage stage;
  Renderer renderer;
};

inline View seen_from(const EyePose& eye, const RenderConfig& config, double vertical_fov_deg = 40.0,
                      double near_plane = 0.05) {
  const double vertical = vertical_fov_deg * 3.14159265358979 / 180.0;
  return view_from(eye, symmetric_fov(vertical, static_cast<double>(config.width) / config.height), near_plane);
}

}  // namespace gearshift
