// The convex regions whose union is free space: the neutral aisle, the vertical aisles and the chamfered mouths of the
// slots.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift::haptics {

inline constexpr double kEdgeTolerance = 1e-12;  // [m] a point this close to an edge counts as inside

struct AisleBox {
  glm::dvec2 min, max;
};

inline bool contains(const AisleBox& box, glm::dvec2 p) noexcept {
  return p.x >= box.min.x - kEdgeTolerance && p.x <= box.max.x + kEdgeTolerance && p.y >= box.min.y - kEdgeTolerance &&
         p.y <= box.max.y + kEdgeTolerance;
}

inline glm::dvec2 nearest(const AisleBox& box, glm::dvec2 p) noexcept {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)};
}

inline AisleBox neutral_aisle(const Gate& gate, const Passage& passage) noexcept {
  return {{passage.select_min, -gate.half_aisle}, {passage.select_max, gate.half_aisle}};
}

// A column's vertical aisle. It is shorter where a lockout closes a slot's mouth or the gearbox limits a slot's depth.
inline AisleBox vertical_aisle(const Gate& gate, const Passage& passage, const Column& column) noexcept {
  const double mouth = gate.half_aisle + gate.chamfer;
  const auto is_closed = [&](int slot) { return slot != kNoSlot && (passage.closed >> slot & 1u) != 0; };
  AisleBox box{{column.center - column.half_width, column.back}, {column.center + column.half_width, column.forward}};
  if (is_closed(column.forward_slot)) box.max.y = mouth;
  if (is_closed(column.back_slot)) box.min.y = -mouth;
  if (passage.limited_slot == kNoSlot) return box;
  if (passage.limited_slot == column.forward_slot) {
    box.max.y = std::min(box.max.y, passage.depth_max);
    if (passage.depth_min > mouth) box.min.y = passage.depth_min;
  } else if (passage.limited_slot == column.back_slot) {
    box.min.y = std::max(box.min.y, -passage.depth_max);
    if (passage.depth_min > mouth) box.max.y = -passage.depth_min;
  }
  return box;
}

// The chamfered mouth of one slot, as a convex region. With u = x - center and v = sign * y, the slot points towards +v
// and the mouth is |u| <= reach, -half_aisle <= v <= top, |u| + v <= reach + half_aisle. The mouth is clipped to min_x
// <= x <= max_x, because the neutral aisle may end inside it (at the gate's end or at a lateral lockout).
struct Mouth {
  double center, sign;  // [m] x of the column; +1 if the slot is forward, -1 if back
  double reach, half_aisle, top;
  double min_x, max_x;
};

inline Mouth mouth_of(const Gate& gate, const Passage& passage, const Column& column, Side side) noexcept {
  const double reach = column.half_width + gate.chamfer;
  return {column.center,
          static_cast<double>(static_cast<int>(side)),
          reach,
          gate.half_aisle,
          gate.half_aisle + gate.chamfer,
          std::max(column.center - reach, passage.select_min),
          std::min(column.center + reach, passage.select_max)};
}

inline bool contains(const Mouth& mouth, glm::dvec2 p) noexcept {
  const double v = mouth.sign * p.y;
  if (p.x < mouth.min_x - kEdgeTolerance || p.x > mouth.max_x + kEdgeTolerance) return false;
  if (v < -mouth.half_aisle - kEdgeTolerance || v > mouth.top + kEdgeTolerance) return false;
  return std::abs(p.x - mouth.center) + v <= mouth.reach + mouth.half_aisle + kEdgeTolerance;
}

inline glm::dvec2 nearest(const Mouth& mouth, glm::dvec2 p) noexcept {
  const AisleBox box{{mouth.min_x, -mouth.half_aisle}, {mouth.max_x, mouth.top}};
  const glm::dvec2 upright{p.x, mouth.sign * p.y};
  glm::dvec2 q = nearest(box, upright);
  const double limit = mouth.reach + mouth.half_aisle;
  if (std::abs(q.x - mouth.center) + q.y > limit) {
    // The point is beyond a chamfer: project it onto the 45 degree line of the chamfer, then clamp it to the ends of
    // the chamfer.
    const double right = upright.x < mouth.center ? -1.0 : 1.0;
    const double u = right * (upright.x - mouth.center);
    const double end = right > 0.0 ? mouth.max_x - mouth.center : mouth.center - mouth.min_x;
    const double foot = std::clamp(0.5 * (u - upright.y + limit), limit - mouth.top, std::max(end, limit - mouth.top));
    q = {mouth.center + right * foot, std::min(limit - foot, mouth.top)};
  }
  return {q.x, mouth.sign * q.y};
}

}  // namespace gearshift::haptics
