// What points at the panel in place of the desk's mouse.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift {

struct PanelPointer {
  glm::dvec2 at{0.0};  // [px]
  bool down = false;
  glm::dvec2 scroll{0.0};  // [lines]
};

}  // namespace gearshift
