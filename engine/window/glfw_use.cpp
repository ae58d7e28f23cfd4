#include "engine/window/glfw_use.h"

#include <GLFW/glfw3.h>

#include <stdexcept>

#include <fmt/format.h>

namespace gearshift {
namespace {

int users = 0;  // GLFW itself is of one thread

}  // namespace

GlfwUse::GlfwUse() {
  if (users == 0 && glfwInit() == GLFW_FALSE) {
    throw std::runtime_error(fmt::format("There is no display to open a window on ({}).", glfw_error()));
  }
  ++users;
}

GlfwUse::~GlfwUse() {
  if (--users == 0) glfwTerminate();
}

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "GLFW gives no reason" : text;
}

}  // namespace gearshift
