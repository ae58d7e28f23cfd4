// Sticks, pads, pedals and wheels as seen by GLFW: axes and buttons, no force.
#pragma once

#include <string>
#include <vector>

namespace gearshift::engine {

// Six axes (left stick, right stick, LT, RT) and fifteen buttons (GLFW_GAMEPAD_BUTTON_A, ...) of a pad, whatever its
// model. Wheels, pedals and other sticks have their own numbers.
struct PadState {
  std::string name;
  std::vector<float> axes;             // [-1, 1]
  std::vector<unsigned char> buttons;  // 0 or 1; of other sticks, the last entries are the four directions of each hat
  std::string guid;                    // identifies the model: two devices of the same model have the same GUID
  bool is_pad = true;                  // GLFW knows the model as a game pad
};

// Returns the devices that are plugged in now, in the order of GLFW's joystick numbers. Call after initialising GLFW,
// on the thread that uses GLFW.
std::vector<PadState> read_pads();

// Like read_pads(), for a program without a window. Throws std::runtime_error with one sentence if there is no display,
// because GLFW needs one even for sticks.
std::vector<PadState> glfw_sticks();

}  // namespace gearshift::engine
