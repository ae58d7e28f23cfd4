#include "engine/window/glfw_use.h"

#include <GLFW/glfw3.h>

#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace gearshift::engine {
namespace {

// No lock is needed, because GLFW is used from one thread only.
int users = 0;
int starts = 0;

}  // namespace

GlfwUse::GlfwUse() {
#ifdef GLFW_PLATFORM  // since 3.4, which prefers Wayland, where windows have no position
  const bool has_only_wayland = std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") != nullptr;
  glfwInitHint(GLFW_PLATFORM, has_only_wayland ? GLFW_PLATFORM_WAYLAND : GLFW_PLATFORM_X11);
#endif
  if (users == 0 && glfwInit() == GLFW_FALSE) {
    throw std::runtime_error(fmt::format("There is no display for a window ({}).", glfw_error()));
  }
  if (users++ == 0) ++starts;
}

GlfwUse::~GlfwUse() {
  if (--users == 0) glfwTerminate();
}

bool glfw_is_in_use() noexcept {
  return users > 0;
}

int glfw_starts() noexcept {
  return starts;
}

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "GLFW reported no reason" : text;
}

}  // namespace gearshift::engine
