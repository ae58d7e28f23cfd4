// How far a point may go along each axis, straight, before a wall stops it.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift {

struct FreeSpan {
  glm::dvec2 low{0.0}, high{0.0};  // [m] left or back end, right or forward end; low <= point <= high
};

// Of the straight line through the point along each axis the part that is free and holds the point: lockouts, chamfers
// and depth limits as in move_proxy(). The point must be in free space. Real-time safe.
FreeSpan free_span(const Gate& gate, const Passage& passage, glm::dvec2 point) noexcept;

// What either of them holds.
FreeSpan joined(const FreeSpan& a, const FreeSpan& b) noexcept;

}  // namespace gearshift
