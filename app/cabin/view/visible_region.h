// The region of an image that is not covered by the panel.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift::cabin {

// Upper left and lower right corner of the region [1], as fractions of the image's size, from its upper left corner.
struct VisibleRegion {
  glm::dvec2 low{0.0}, high{1.0};
};

}  // namespace gearshift::cabin
