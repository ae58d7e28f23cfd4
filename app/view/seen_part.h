// The part of a picture that nothing lies before.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift {

// In shares of the picture, from its upper left corner. [1]
struct SeenPart {
  glm::dvec2 low{0.0}, high{1.0};
};

}  // namespace gearshift
