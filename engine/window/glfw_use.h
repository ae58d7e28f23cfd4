// Reference-counted initialisation of GLFW.
#pragma once

#include <string>

namespace gearshift::engine {

class GlfwUse {
 public:
  GlfwUse();  // throws std::runtime_error with one sentence if there is no display
  ~GlfwUse();
  GlfwUse(const GlfwUse&) = delete;
  GlfwUse& operator=(const GlfwUse&) = delete;
};

bool glfw_is_in_use() noexcept;
int glfw_starts() noexcept;  // number of initialisations so far

// Returns the text of GLFW's last error and clears the error. The text is never empty.
std::string glfw_error();

}  // namespace gearshift::engine
