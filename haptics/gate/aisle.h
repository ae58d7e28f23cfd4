// Geometry of straight aisles with round ends, of which other mechanisms than H gates consist. Each aisle is convex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift::haptics {

// [1] as fractions of a place's radius: where its lockout stands, and where a lever that may not leave it is stopped.
inline constexpr double kClosedRadius = 0.85;
inline constexpr double kHeldRadius = 0.5;

inline constexpr double kOnLine = 1e-4;  // [m] a point this close to a centre line is on it

// [m] position of the point along the aisle's centre line; outside 0 to `length` beyond the ends.
inline double position_along(const Aisle& aisle, glm::dvec2 p) noexcept {
  return glm::dot(p - aisle.from, aisle.along);
}

// [m] distance of the point from the centre line
inline double distance_to(const Aisle& aisle, glm::dvec2 p) noexcept {
  const double s = std::clamp(position_along(aisle, p), 0.0, aisle.length);
  return glm::distance(p, aisle.from + s * aisle.along);
}

// The largest distances [m] of a wall from the origin, sideways and fore and aft, in a gate of any kind.
inline glm::dvec2 half_extent(const Gate& gate) noexcept {
  glm::dvec2 reach{std::max(-gate.select_min, gate.select_max), gate.half_aisle};
  if (!is_mechanism(gate)) {
    for (const Slot& slot : slots(gate)) reach.y = std::max(reach.y, slot.end);
    return reach;
  }
  for (const Aisle& aisle : aisles(gate))
    reach = glm::max(reach, glm::max(glm::abs(aisle.from), glm::abs(aisle.to)) + aisle.half_width);
  return reach;
}

// A part of an aisle that ends at lockouts: all points within the aisle's half width of the line from `low` to `high`.
// Empty if high < low. [m] along the aisle
struct AislePart {
  const Aisle& aisle;
  double low, high;
};

inline AislePart whole(const Aisle& aisle) noexcept {
  return {aisle, 0.0, aisle.length};
}

// The part of the aisle in which a lever at `p` may move.
inline AislePart open_part(const Gate& gate, const Passage& passage, int index, glm::dvec2 p) noexcept {
  const Aisle& aisle = gate.aisle[static_cast<std::size_t>(index)];
  AislePart part = whole(aisle);
  if (passage.closed == 0 && passage.held_slot == kNoSlot) return part;
  for (int i = 0; i < gate.slot_count; ++i) {
    const Slot& place = slot_of(gate, i);
    if ((place.aisles >> index & 1u) == 0) continue;
    const double at = position_along(aisle, place.at);
    if ((passage.closed >> i & 1u) != 0) {
      const double gap = kClosedRadius * place.end + aisle.half_width;
      if (position_along(aisle, p) < at)
        part.high = std::min(part.high, at - gap);
      else
        part.low = std::max(part.low, at + gap);
    }
    if (passage.held_slot == i) {
      const double room = std::max(0.0, kHeldRadius * place.end - aisle.half_width);
      part.low = std::max(part.low, at - room);
      part.high = std::min(part.high, at + room);
    }
  }
  return part;
}

// The point of the centre line, within the part, that is nearest to `p`. The part must not be empty.
inline glm::dvec2 center_near(const AislePart& part, glm::dvec2 p) noexcept {
  return part.aisle.from + std::clamp(position_along(part.aisle, p), part.low, part.high) * part.aisle.along;
}

// `tolerance`: [m] a point this close to the edge counts as inside.
inline bool contains(const AislePart& part, glm::dvec2 p, double tolerance) noexcept {
  if (part.high < part.low) return false;
  const double reach = part.aisle.half_width + tolerance;
  const glm::dvec2 off = p - center_near(part, p);
  return glm::dot(off, off) <= reach * reach;
}

inline glm::dvec2 nearest(const AislePart& part, glm::dvec2 p) noexcept {
  const glm::dvec2 center = center_near(part, p);
  const double distance = glm::distance(p, center);
  return distance <= part.aisle.half_width ? p : center + (p - center) * (part.aisle.half_width / distance);
}

// [m] An interval on a line, as distances from a point of the line; empty if high < low.
struct LineInterval {
  double low = 1.0, high = -1.0;
};

// The part of the line through `p` along the unit vector `direction` that lies inside the aisle's part.
LineInterval line_inside(const AislePart& part, glm::dvec2 p, glm::dvec2 direction) noexcept;

// The point where the centre lines of two aisles meet; none if they lie apart.
std::optional<glm::dvec2> meeting_point(const Aisle& a, const Aisle& b) noexcept;

// The part of aisle `a`, as positions along it [m], in which its cross-section meets aisle `b`. The aisles must meet.
LineInterval overlap_along(const Aisle& a, const Aisle& b) noexcept;

// The unit vectors that lead from a point on the centre line along the aisle: one at its end, otherwise two.
std::vector<glm::dvec2> ways_from(const Aisle& aisle, glm::dvec2 at);

// The parts of an aisle in which others meet it, in order along it, and the free stretches between these.
std::vector<LineInterval> overlaps_of(const Gate& gate, std::size_t aisle);
std::vector<LineInterval> stretches_of(const Gate& gate, std::size_t aisle);

}  // namespace gearshift::haptics
