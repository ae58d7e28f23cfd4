// Game controllers as the window reports them.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/window/controllers.h"

namespace gearshift::test {

// A wheel, pedal set, stick or shifter, which GLFW does not know. `buttons`: all released.
inline engine::Controller controller(std::string name, std::vector<float> axes, std::size_t buttons = 0,
                                     std::string id = "") {
  engine::Controller made;
  made.name = std::move(name);
  made.id = made.guid = std::move(id);
  made.axes = std::move(axes);
  made.buttons.assign(buttons, 0);
  return made;
}

// A game pad that GLFW knows, with these values of its mapped controls.
inline engine::Controller gamepad(const std::vector<float>& axes, const std::vector<unsigned char>& buttons = {}) {
  engine::Controller made = controller("A pad", {}, 0, "045e:028e");
  made.gamepad.emplace();
  std::copy(axes.begin(), axes.end(), made.gamepad->axes.begin());
  std::copy(buttons.begin(), buttons.end(), made.gamepad->buttons.begin());
  return made;
}

}  // namespace gearshift::test
