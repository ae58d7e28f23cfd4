#include "haptics/contact/free_span.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "haptics/contact/free_space.h"

namespace gearshift {
namespace {

// A part of a line: none of it where high < low.
struct Stretch {
  double low = 1.0, high = -1.0;
};

// What an aisle holds of the line through p along that axis.
Stretch stretch(const Box& box, glm::dvec2 p, int axis) noexcept {
  const int other = 1 - axis;
  if (p[other] < box.min[other] - kTouch || p[other] > box.max[other] + kTouch) return {};
  return {box.min[axis], box.max[axis]};
}

Stretch stretch(const Mouth& mouth, glm::dvec2 p, int axis) noexcept {
  const double limit = mouth.reach + mouth.half_aisle;
  if (axis == 0) {
    const double v = mouth.sign * p.y;
    if (v < -mouth.half_aisle - kTouch || v > mouth.top + kTouch) return {};
    const double half = std::min(mouth.reach, limit - v);
    return {std::max(mouth.min_x, mouth.center - half), std::min(mouth.max_x, mouth.center + half)};
  }
  if (p.x < mouth.min_x - kTouch || p.x > mouth.max_x + kTouch) return {};
  const double top = std::min(mouth.top, limit - std::abs(p.x - mouth.center));
  return mouth.sign > 0.0 ? Stretch{-mouth.half_aisle, top} : Stretch{-top, mouth.half_aisle};
}

// Goes on into a part that touches it.
void grow(Stretch& span, Stretch part) noexcept {
  if (part.high < part.low || part.low > span.high + kTouch || part.high < span.low - kTouch) return;
  span = {std::min(span.low, part.low), std::max(span.high, part.high)};
}

}  // namespace

// The nearest column's aisles and the neutral aisle are all that such a line can meet: columns lie apart, mouths
// included, and between them the neutral aisle is all there is.
FreeSpan free_span(const Gate& gate, const Passage& passage, glm::dvec2 point) noexcept {
  const Column& column = column_of(gate, nearest_column(gate, point.x));
  const Mouth forward = mouth_of(gate, passage, column, Side::forward);
  const Mouth back = mouth_of(gate, passage, column, Side::back);
  FreeSpan span;
  for (int axis = 0; axis < 2; ++axis) {
    const std::array parts{stretch(vertical_aisle(gate, passage, column), point, axis),
                           column.forward_slot == kNoSlot ? Stretch{} : stretch(forward, point, axis),
                           column.back_slot == kNoSlot ? Stretch{} : stretch(back, point, axis),
                           stretch(neutral_aisle(gate, passage), point, axis)};
    Stretch whole{point[axis], point[axis]};
    for (int pass = 0; pass < 2; ++pass)  // from a mouth through the aisle into the one opposite
      for (const Stretch& part : parts) grow(whole, part);
    span.low[axis] = whole.low;
    span.high[axis] = whole.high;
  }
  return span;
}

FreeSpan joined(const FreeSpan& a, const FreeSpan& b) noexcept {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

}  // namespace gearshift
