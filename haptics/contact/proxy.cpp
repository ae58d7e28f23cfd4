#include "haptics/contact/proxy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift {
namespace {

using glm::dvec2;

constexpr double kTouch = 1e-12;  // [m] a point this near an aisle's edge is on it
constexpr int kMaxLegs = 8;       // straight moves per cycle; stopping early is always safe

struct Box {
  dvec2 min, max;
};

bool contains(const Box& box, dvec2 p) noexcept {
  return p.x >= box.min.x - kTouch && p.x <= box.max.x + kTouch && p.y >= box.min.y - kTouch &&
         p.y <= box.max.y + kTouch;
}

dvec2 nearest(const Box& box, dvec2 p) noexcept {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)};
}

Box neutral_aisle(const Gate& gate, const Passage& passage) noexcept {
  return {{passage.select_min, -gate.half_aisle}, {passage.select_max, gate.half_aisle}};
}

// A vertical aisle, cut short where a lockout closes a slot's mouth or the gearbox limits its depth.
Box vertical_aisle(const Gate& gate, const Passage& passage, const Column& column) noexcept {
  const double mouth = gate.half_aisle + gate.chamfer;
  const auto is_closed = [&](int slot) { return slot != kNoSlot && (passage.closed >> slot & 1u) != 0; };
  Box box{{column.center - column.half_width, column.back}, {column.center + column.half_width, column.forward}};
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

// The chamfered mouth of one slot, seen with the slot upwards and to the right of the column's centre line:
// the convex region |u| <= reach, -half_aisle <= v <= top, |u| + v <= reach + half_aisle. The neutral aisle
// may be narrower there (its ends, a lateral lockout), so the box is cut to it.
struct Mouth {
  double center, sign;  // x of the column, +1 forward or -1 back
  double reach, half_aisle, top;
  double min_x, max_x;
};

Mouth mouth_of(const Gate& gate, const Passage& passage, const Column& column, Side side) noexcept {
  const double reach = column.half_width + gate.chamfer;
  return {column.center,
          static_cast<double>(static_cast<int>(side)),
          reach,
          gate.half_aisle,
          gate.half_aisle + gate.chamfer,
          std::max(column.center - reach, passage.select_min),
          std::min(column.center + reach, passage.select_max)};
}

bool contains(const Mouth& mouth, dvec2 p) noexcept {
  const double v = mouth.sign * p.y;
  if (p.x < mouth.min_x - kTouch || p.x > mouth.max_x + kTouch) return false;
  if (v < -mouth.half_aisle - kTouch || v > mouth.top + kTouch) return false;
  return std::abs(p.x - mouth.center) + v <= mouth.reach + mouth.half_aisle + kTouch;
}

dvec2 nearest(const Mouth& mouth, dvec2 p) noexcept {
  const Box box{{mouth.min_x, -mouth.half_aisle}, {mouth.max_x, mouth.top}};
  const dvec2 upright{p.x, mouth.sign * p.y};
  dvec2 q = nearest(box, upright);
  const double limit = mouth.reach + mouth.half_aisle;
  if (std::abs(q.x - mouth.center) + q.y > limit) {
    // Beyond a chamfer: the foot on its 45 degree line, kept on the chamfer.
    const double right = upright.x < mouth.center ? -1.0 : 1.0;
    const double u = right * (upright.x - mouth.center);
    const double end = right > 0.0 ? mouth.max_x - mouth.center : mouth.center - mouth.min_x;
    const double foot = std::clamp(0.5 * (u - upright.y + limit), limit - mouth.top, std::max(end, limit - mouth.top));
    q = {mouth.center + right * foot, std::min(limit - foot, mouth.top)};
  }
  return {q.x, mouth.sign * q.y};
}

double distance2(dvec2 a, dvec2 b) noexcept {
  const dvec2 d = a - b;
  return glm::dot(d, d);
}

// Where the proxy would go next: the nearest point to the lever in any one aisle that holds the proxy.
dvec2 next_leg(const Gate& gate, const Passage& passage, dvec2 p, dvec2 lever) noexcept {
  dvec2 best = p;
  double best2 = distance2(p, lever);
  const auto offer = [&](dvec2 q) {
    const double d2 = distance2(q, lever);
    if (d2 < best2) {
      best = q;
      best2 = d2;
    }
  };
  const Column& column = gate.column[static_cast<std::size_t>(nearest_column(gate, p.x))];
  const Box vertical = vertical_aisle(gate, passage, column);
  if (contains(vertical, p)) offer(nearest(vertical, lever));
  if (best2 == 0.0 || std::abs(p.y) > gate.half_aisle + gate.chamfer + kTouch) return best;

  const Box neutral = neutral_aisle(gate, passage);
  if (contains(neutral, p)) offer(nearest(neutral, lever));
  if (best2 == 0.0 || gate.chamfer == 0.0) return best;
  for (const auto& [slot, side] : {std::pair{column.forward_slot, Side::forward}, {column.back_slot, Side::back}}) {
    if (slot == kNoSlot) continue;
    const Mouth mouth = mouth_of(gate, passage, column, side);
    if (contains(mouth, p)) offer(nearest(mouth, lever));
  }
  return best;
}

}  // namespace

Proxy place_proxy(const Gate& gate, dvec2 lever) noexcept {
  const Passage passage = open_passage(gate);
  dvec2 best = nearest(neutral_aisle(gate, passage), lever);
  const auto offer = [&](dvec2 q) {
    if (distance2(q, lever) < distance2(best, lever)) best = q;
  };
  for (int i = 0; i < gate.column_count; ++i) {
    const Column& column = gate.column[static_cast<std::size_t>(i)];
    offer(nearest(vertical_aisle(gate, passage, column), lever));
    if (column.forward_slot != kNoSlot) offer(nearest(mouth_of(gate, passage, column, Side::forward), lever));
    if (column.back_slot != kNoSlot) offer(nearest(mouth_of(gate, passage, column, Side::back), lever));
  }
  return {best, lever};
}

Proxy move_proxy(const Gate& gate, const Passage& passage, Proxy proxy, dvec2 lever, double hand_over) noexcept {
  if (!is_finite(lever)) return proxy;
  double budget = glm::distance(lever, proxy.lever) + hand_over;
  proxy.lever = lever;
  for (int leg = 0; leg < kMaxLegs && proxy.position != lever; ++leg) {
    const dvec2 to = next_leg(gate, passage, proxy.position, lever);
    const double length = glm::distance(to, proxy.position);
    if (length > budget) {
      proxy.position += (to - proxy.position) * (budget / length);
      break;
    }
    proxy.position = to;
    if (length < kTouch) break;
    budget -= length;
  }
  return proxy;
}

}  // namespace gearshift
