// A pointer that replaces the desktop mouse on the panel, such as a VR controller.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift::session {

struct PanelPointer {
  glm::dvec2 at{0.0};  // [px]
  bool down = false;
  glm::dvec2 scroll{0.0};  // [lines]
};

}  // namespace gearshift::session
