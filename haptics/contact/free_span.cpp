#include "haptics/contact/free_span.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "haptics/contact/free_space.h"
#include "haptics/gate/aisle.h"

namespace gearshift::haptics {
namespace {

// An interval on a line; empty if high < low.
struct Interval {
  double low = 1.0, high = -1.0;
};

// The part of the line through p, parallel to `axis`, that lies inside the aisle.
Interval interval_in(const AisleBox& box, glm::dvec2 p, int axis) noexcept {
  const int other = 1 - axis;
  if (p[other] < box.min[other] - kEdgeTolerance || p[other] > box.max[other] + kEdgeTolerance) return {};
  return {box.min[axis], box.max[axis]};
}

Interval interval_in(const Mouth& mouth, glm::dvec2 p, int axis) noexcept {
  const double limit = mouth.reach + mouth.half_aisle;
  if (axis == 0) {
    const double v = mouth.sign * p.y;
    if (v < -mouth.half_aisle - kEdgeTolerance || v > mouth.top + kEdgeTolerance) return {};
    const double half = std::min(mouth.reach, limit - v);
    return {std::max(mouth.min_x, mouth.center - half), std::min(mouth.max_x, mouth.center + half)};
  }
  if (p.x < mouth.min_x - kEdgeTolerance || p.x > mouth.max_x + kEdgeTolerance) return {};
  const double top = std::min(mouth.top, limit - std::abs(p.x - mouth.center));
  return mouth.sign > 0.0 ? Interval{-mouth.half_aisle, top} : Interval{-top, mouth.half_aisle};
}

// Extends the span by `part` if the two touch or overlap.
void extend(Interval& span, Interval part) noexcept {
  if (part.high < part.low || part.low > span.high + kEdgeTolerance || part.high < span.low - kEdgeTolerance) return;
  span = {std::min(span.low, part.low), std::max(span.high, part.high)};
}

// One pass per aisle, because each part may touch the span only through another.
FreeSpan span_in_aisles(const Gate& gate, const Passage& passage, glm::dvec2 point) noexcept {
  FreeSpan span;
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec2 direction{axis == 0 ? 1.0 : 0.0, axis == 0 ? 0.0 : 1.0};
    Interval on_axis{0.0, 0.0};
    for (int pass = 0; pass < gate.aisle_count; ++pass) {
      const Interval before = on_axis;
      for (int i = 0; i < gate.aisle_count; ++i) {
        const LineInterval part = line_inside(open_part(gate, passage, i, point), point, direction);
        extend(on_axis, {part.low, part.high});
      }
      if (on_axis.low == before.low && on_axis.high == before.high) break;
    }
    span.low[axis] = point[axis] + on_axis.low;
    span.high[axis] = point[axis] + on_axis.high;
  }
  return span;
}

}  // namespace

// It suffices to examine the neutral aisle and the nearest column with its mouths: columns with their mouths do not
// overlap, and only the neutral aisle lies between them.
FreeSpan free_span(const Gate& gate, const Passage& passage, glm::dvec2 point) noexcept {
  if (is_mechanism(gate)) [[unlikely]]
    return span_in_aisles(gate, passage, point);
  const Column& column = column_of(gate, nearest_column(gate, point.x));
  const Mouth forward = mouth_of(gate, passage, column, Side::forward);
  const Mouth back = mouth_of(gate, passage, column, Side::back);
  FreeSpan span;
  for (int axis = 0; axis < 2; ++axis) {
    const std::array parts{interval_in(vertical_aisle(gate, passage, column), point, axis),
                           column.forward_slot == kNoSlot ? Interval{} : interval_in(forward, point, axis),
                           column.back_slot == kNoSlot ? Interval{} : interval_in(back, point, axis),
                           interval_in(neutral_aisle(gate, passage), point, axis)};
    Interval span_on_axis{point[axis], point[axis]};
    for (int pass = 0; pass < 2; ++pass)  // two passes: a part may touch the span only through a part later in `parts`
      for (const Interval& part : parts) extend(span_on_axis, part);
    span.low[axis] = span_on_axis.low;
    span.high[axis] = span_on_axis.high;
  }
  return span;
}

FreeSpan bounding_span(const FreeSpan& a, const FreeSpan& b) noexcept {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

}  // namespace gearshift::haptics
