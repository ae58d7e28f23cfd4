// The six-gear tour of the paper's gate by the gripping hand: the load that the cycle's figures are measured
// under.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift {

inline Gate bench_gate(const std::string& folder, const std::string& name) {
  return compile_gate(read_gate_layout(folder + "/" + name + ".toml"), workspace_half_extent(YokeGeometry{}));
}

inline ScriptedHand touring_driver(const Gate& gate, double period) {
  const glm::dvec2 start = rest_position(gate, kNeutralGear);
  return {touring_hand(start), shift_strokes(gate, start, tour_order(gate)), period};
}

inline SimulatedRunConfig touring_config(const Gate& gate) {
  SimulatedRunConfig config;
  config.lever.hand = kGripHand;
  config.gate = gate;
  return config;
}

}  // namespace gearshift
