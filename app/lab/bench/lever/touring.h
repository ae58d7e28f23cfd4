// A gripping hand that shifts through the six gears of the paper's gate while the haptic cycle is measured.
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

namespace gearshift::lab {

inline haptics::Gate bench_gate(const std::string& folder, const std::string& name) {
  return haptics::compile_gate(haptics::read_gate_layout(folder + "/" + name + ".toml"),
                               haptics::workspace_half_extent(haptics::YokeGeometry{}));
}

inline haptics::ScriptedHand touring_driver(const haptics::Gate& gate, double period) {
  const glm::dvec2 start = haptics::rest_position(gate, haptics::kNeutralGear);
  return {haptics::touring_hand(start), haptics::shift_strokes(gate, start, haptics::tour_order(gate)), period};
}

inline haptics::SimulatedRunConfig touring_config(const haptics::Gate& gate) {
  haptics::SimulatedRunConfig config;
  config.lever.hand = haptics::kGripHand;
  config.gate = gate;
  return config;
}

}  // namespace gearshift::lab
