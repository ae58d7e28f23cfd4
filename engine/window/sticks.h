// Sticks, pads, pedals and wheels as GLFW sees them: axes and buttons, no force.
#pragma once

#include <string>
#include <vector>

namespace gearshift {

struct PadState {
  std::string name;
  std::vector<float> axes;             // [-1, 1]
  std::vector<unsigned char> buttons;  // 0 or 1; a hat's four directions stand behind the others
  std::string guid;                    // of the model, not of the piece: two of a kind have the same
};

// What is plugged in now, in the order in which it was. GLFW must be in use, and this its thread.
std::vector<PadState> read_pads();

// The same for a program without a window. Throws std::runtime_error with one sentence where there is no display: GLFW
// needs one for sticks, too.
std::vector<PadState> glfw_sticks();

}  // namespace gearshift
