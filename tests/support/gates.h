// The shipped gates, compiled for the joystick that haptics/joystick models.
#pragma once

#include <string>
#include <vector>

#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::test {

// [m] largest deflections, select and shift: 0.12 sin(40 deg), 0.12 sin(35 deg)
inline constexpr glm::dvec2 kPaperWorkspace{0.077134, 0.068829};

inline haptics::Gate shipped_gate(const std::string& name) {
  return haptics::compile_gate(haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/" + name + ".toml"), kPaperWorkspace);
}

inline haptics::Gate paper_gate() {
  return shipped_gate("paper");
}

inline double paper_feel() {  // [N/m]
  static const double feel = haptics::max_feel_stiffness(paper_gate());
  return feel;
}

inline constexpr const char* kSequentialGate = "sequential_six";

// The shipped mechanisms of aisles, which no car has.
inline constexpr const char* kMechanisms[] = {"selector_p_r_n_d", "crane_cross"};

// The shipped gates with a slot per gear.
inline std::vector<std::string> shipped_names() {
  return {"paper",
          "five_speed_r_left_up",
          "five_speed_r_right_down",
          "six_speed_r_left_up",
          "six_speed_r_left_down",
          "six_speed_r_right_down",
          "dog_leg_five",
          "four_speed",
          "six_speed_r_left_spring",
          "open_gate_six",
          "seven_speed",
          "three_on_the_tree"};
}

}  // namespace gearshift::test
