// GLFW is initialised while somebody uses it.
#pragma once

#include <string>

namespace gearshift {

class GlfwUse {
 public:
  GlfwUse();  // throws std::runtime_error with one sentence where there is no display
  ~GlfwUse();
  GlfwUse(const GlfwUse&) = delete;
  GlfwUse& operator=(const GlfwUse&) = delete;
};

// The last error's text, taken; never empty.
std::string glfw_error();

}  // namespace gearshift
