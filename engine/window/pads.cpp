#include "engine/window/pads.h"

#include <GLFW/glfw3.h>

#include <iterator>

#include "engine/window/glfw_use.h"

namespace gearshift::engine {

std::vector<PadState> read_pads() {
  std::vector<PadState> pads;
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    if (glfwJoystickPresent(id) == GLFW_FALSE) continue;
    int axes = 0, buttons = 0;
    const float* axis = glfwGetJoystickAxes(id, &axes);
    const unsigned char* button = glfwGetJoystickButtons(id, &buttons);
    const char* name = glfwGetJoystickName(id);
    const char* guid = glfwGetJoystickGUID(id);
    if (name == nullptr || guid == nullptr) continue;  // the device was just unplugged
    GLFWgamepadstate mapped;
    if (glfwGetGamepadState(id, &mapped) == GLFW_TRUE)
      pads.push_back({name,
                      {std::begin(mapped.axes), std::end(mapped.axes)},
                      {std::begin(mapped.buttons), std::end(mapped.buttons)},
                      guid,
                      true});
    else
      pads.push_back({name, {axis, axis + axes}, {button, button + buttons}, guid, false});
  }
  return pads;
}

std::vector<PadState> glfw_sticks() {
  const GlfwUse use;
  return read_pads();
}

}  // namespace gearshift::engine
