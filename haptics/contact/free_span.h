// How far a point can move straight along each axis before it meets a wall.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift::haptics {

struct FreeSpan {
  glm::dvec2 low{0.0}, high{0.0};  // [m] per axis: low end (left, back), high end (right, forward)
};

// For each axis: the free interval around the point, on the line through the point parallel to the axis. Respects
// lockouts, chamfers and depth limits like move_proxy(). The point must be in free space. Real-time safe.
FreeSpan free_span(const Gate& gate, const Passage& passage, glm::dvec2 point) noexcept;

// The smallest span that contains both spans.
FreeSpan bounding_span(const FreeSpan& a, const FreeSpan& b) noexcept;

}  // namespace gearshift::haptics
