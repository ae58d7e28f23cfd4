#include "haptics/contact/proxy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>

#include "haptics/contact/free_space.h"
#include "haptics/gate/aisle.h"
#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

constexpr int kMaxLegs = 8;  // maximum number of straight moves per cycle; fewer are safe

double distance2(dvec2 a, dvec2 b) noexcept {
  const dvec2 d = a - b;
  return glm::dot(d, d);
}

// Beyond this depth a slot's aisle is the only free space.
double mouth_end(const Gate& gate) noexcept {
  return gate.half_aisle + gate.chamfer + kEdgeTolerance;
}

// next_leg() in a mechanism of aisles.
dvec2 next_leg_in_aisles(const Gate& gate, const Passage& passage, dvec2 p, dvec2 lever) noexcept {
  dvec2 best = p;
  double best2 = distance2(p, lever);
  for (int i = 0; i < gate.aisle_count && best2 > 0.0; ++i) {
    const AislePart part = open_part(gate, passage, i, p);
    if (!contains(part, p, kEdgeTolerance)) continue;
    const dvec2 q = nearest(part, lever);
    const double d2 = distance2(q, lever);
    if (d2 < best2) {
      best = q;
      best2 = d2;
    }
  }
  return best;
}

// Target of the proxy's next straight move: the point nearest to the lever in any aisle or mouth that contains the
// proxy.
dvec2 next_leg(const Gate& gate, const Passage& passage, dvec2 p, dvec2 lever) noexcept {
  if (is_mechanism(gate)) [[unlikely]]
    return next_leg_in_aisles(gate, passage, p, lever);
  dvec2 best = p;
  double best2 = distance2(p, lever);
  const auto consider = [&](dvec2 q) {
    const double d2 = distance2(q, lever);
    if (d2 < best2) {
      best = q;
      best2 = d2;
    }
  };
  const Column& column = gate.column[static_cast<std::size_t>(nearest_column(gate, p.x))];
  const AisleBox vertical = vertical_aisle(gate, passage, column);
  if (contains(vertical, p)) consider(nearest(vertical, lever));
  if (best2 == 0.0 || std::abs(p.y) > mouth_end(gate)) return best;

  const AisleBox neutral = neutral_aisle(gate, passage);
  if (contains(neutral, p)) consider(nearest(neutral, lever));
  if (best2 == 0.0 || gate.chamfer == 0.0) return best;
  for (const auto& [slot, side] : {std::pair{column.forward_slot, Side::forward}, {column.back_slot, Side::back}}) {
    if (slot == kNoSlot) continue;
    const Mouth mouth = mouth_of(gate, passage, column, side);
    if (contains(mouth, p)) consider(nearest(mouth, lever));
  }
  return best;
}

dvec2 nearest_in_aisles(const Gate& gate, dvec2 lever) noexcept {
  dvec2 best = nearest(whole(gate.aisle[0]), lever);
  for (const Aisle& aisle : aisles(gate)) {
    const dvec2 q = nearest(whole(aisle), lever);
    if (distance2(q, lever) < distance2(best, lever)) best = q;
  }
  return best;
}

}  // namespace

Proxy place_proxy(const Gate& gate, dvec2 lever) noexcept {
  const Passage passage = open_passage(gate);
  if (is_mechanism(gate)) [[unlikely]]
    return {nearest_in_aisles(gate, lever), lever};
  dvec2 best = nearest(neutral_aisle(gate, passage), lever);
  const auto consider = [&](dvec2 q) {
    if (distance2(q, lever) < distance2(best, lever)) best = q;
  };
  for (int i = 0; i < gate.column_count; ++i) {
    const Column& column = gate.column[static_cast<std::size_t>(i)];
    consider(nearest(vertical_aisle(gate, passage, column), lever));
    if (column.forward_slot != kNoSlot) consider(nearest(mouth_of(gate, passage, column, Side::forward), lever));
    if (column.back_slot != kNoSlot) consider(nearest(mouth_of(gate, passage, column, Side::back), lever));
  }
  return {best, lever};
}

Proxy move_proxy(const Gate& gate, const Passage& passage, Proxy proxy, dvec2 lever, double hand_over) noexcept {
  if (!is_finite(lever)) return proxy;
  dvec2 to = next_leg(gate, passage, proxy.position, lever);
  // The most frequent case, a free lever that stays in its aisle, needs no distances: the proxy moves as far as the lever.
  if (to == lever && proxy.position == proxy.lever) return {to, lever};

  double budget = glm::distance(lever, proxy.lever) + hand_over;
  proxy.lever = lever;
  for (int leg = 1; to != proxy.position; ++leg) {
    const double length = glm::distance(to, proxy.position);
    if (length > budget) {
      proxy.position += (to - proxy.position) * (budget / length);
      break;
    }
    const bool in_one_aisle =
        !is_mechanism(gate) && std::min(std::abs(proxy.position.y), std::abs(to.y)) > mouth_end(gate);
    proxy.position = to;
    if (in_one_aisle || length < kEdgeTolerance || to == lever || leg == kMaxLegs) break;
    budget -= length;
    to = next_leg(gate, passage, proxy.position, lever);
  }
  return proxy;
}

}  // namespace gearshift::haptics
