// The region of an image that is not covered by the panel.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift::cabin {

// Corners of the region, as fractions of the image, from its upper left corner. [1]
struct VisibleRegion {
  glm::dvec2 low{0.0}, high{1.0};
};

}  // namespace gearshift::cabin
