#include "haptics/loop/shift_script.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

// Collects strokes and computes each stroke's duration from its length.
class StrokeWriter {
 public:
  StrokeWriter(dvec2 start, const ShiftStyle& style) : at_(start), style_(style) {}

  // `push`: [N] of the hand at `to`
  void move_to(dvec2 to, double dwell, dvec2 push = dvec2(0.0)) {
    const double distance = glm::distance(at_, to);
    if (distance < 1e-6) return;
    HandStroke stroke;
    stroke.to = to;
    stroke.duration = style_.reaction + distance / style_.pace;
    stroke.dwell = dwell;
    stroke.push = push;
    stroke.pressed_down = pressed_;
    stroke.lifted = lifted_;
    strokes_.push_back(stroke);
    at_ = to;
  }

  void hold(bool pressed, bool lifted) {
    pressed_ = pressed;
    lifted_ = lifted;
  }

  dvec2 at() const { return at_; }
  std::vector<HandStroke> take() { return std::move(strokes_); }

 private:
  dvec2 at_;
  const ShiftStyle& style_;
  bool pressed_ = false;
  bool lifted_ = false;
  std::vector<HandStroke> strokes_;
};

// `gear`: the engaged gear.
bool has_lockout(const Gate& gate, int slot, LockoutKind kind, int gear) {
  return std::any_of(gate.lockout.begin(), gate.lockout.begin() + gate.lockout_count, [&](const Lockout& lockout) {
    if (lockout.from_gear != kAnyGear && lockout.from_gear != gear) return false;
    return lockout.slot == slot && lockout.kind == kind &&
           (kind != LockoutKind::after_gear || lockout.after_gear == gear);
  });
}

const Column& column_at(const Gate& gate, double x) {
  return gate.column[static_cast<std::size_t>(nearest_column(gate, x))];
}

// An x position outside the column at `x`: the centre of the neutral column, or half way to a neighbouring column if
// `x` is in the neutral column.
double detour_x(const Gate& gate, double x) {
  const int here = nearest_column(gate, x);
  const double center = gate.column[static_cast<std::size_t>(here)].center;
  if (here != gate.neutral_column) return gate.column[static_cast<std::size_t>(gate.neutral_column)].center;
  return 0.5 * (center + gate.column[static_cast<std::size_t>(here > 0 ? here - 1 : here + 1)].center);
}

constexpr double kLean = 0.0015;  // [m] how far the hand aims beyond a wall

// Offset of the aim in x. On the way into an outer slot, a hand slides along the gate's end wall, so it aims beyond
// that wall. On the way into an inner slot, it aims at the slot's middle.
double lean_at(const Gate& gate, double x, double direction) {
  const double half_width = column_at(gate, x).half_width;
  const double wall = x + std::copysign(half_width, direction);
  const bool ends_gate = wall <= gate.select_min || wall >= gate.select_max;
  return ends_gate ? std::copysign(half_width + kLean, direction) : 0.0;
}

// Strokes of a sequential gate until `to` is engaged; ends in the neutral aisle. Returns the gear that is engaged then.
int shift_in_sequence(const Gate& gate, int gear, int to, const ShiftStyle& style, StrokeWriter& writer) {
  while (gear != to && has_gear(gate, to)) {
    const int index = slot_of_gear(gate, to > gear ? kNextGear : kPreviousGear);
    const Slot& slot = slot_of(gate, index);
    const double x = column_of(gate, slot.column).center;
    const bool opens = style.opens_lockouts;
    writer.hold(opens && has_lockout(gate, index, LockoutKind::push_down, gear),
                opens && has_lockout(gate, index, LockoutKind::lift, gear));
    writer.move_to({x, static_cast<int>(slot.side) * (slot.end + (style.leans ? kLean : 0.0))}, style.dwell_gear);
    writer.hold(false, false);
    writer.move_to({x, 0.0}, style.dwell_neutral);
    gear = gear_behind(gate, index, gear);
  }
  return gear;
}

// A stop on the way through the aisles of a mechanism: a turn or a place.
struct RouteStop {
  dvec2 at{0.0};
  int slot = kNoSlot;
};

// Points on centre lines between which a hand moves straight: first `from`, then all places, then where aisles meet.
std::vector<RouteStop> route_stops(const Gate& gate, dvec2 from) {
  std::vector<RouteStop> stops{{from, kNoSlot}};
  for (int i = 0; i < gate.slot_count; ++i) stops.push_back({slot_of(gate, i).at, i});
  const auto all = aisles(gate);
  const auto is_place = [&](dvec2 at) {  // a hand that turns there must open the place's lockouts
    const auto places = slots(gate);
    return std::any_of(places.begin(), places.end(),
                       [&](const Slot& place) { return glm::distance(place.at, at) < kOnLine; });
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::optional<dvec2> at = meeting_point(all[i], all[k]);
      if (at && !is_place(*at)) stops.push_back({*at, kNoSlot});
    }
  }
  return stops;
}

bool is_between(dvec2 p, dvec2 a, dvec2 b) {
  const double detour = glm::distance(a, p) + glm::distance(p, b) - glm::distance(a, b);
  return detour < kOnLine && glm::distance(a, p) > kOnLine && glm::distance(p, b) > kOnLine;
}

// True if one aisle leads straight from a to b, past no other place.
bool leads_straight(const Gate& gate, dvec2 a, dvec2 b) {
  const auto places = slots(gate);
  if (std::any_of(places.begin(), places.end(), [&](const Slot& place) { return is_between(place.at, a, b); }))
    return false;
  const auto all = aisles(gate);
  return std::any_of(all.begin(), all.end(), [&](const Aisle& aisle) {
    return distance_to(aisle, a) < aisle.half_width && distance_to(aisle, b) < kOnLine;
  });
}

// The shortest way through the aisles (Dijkstra) from a point to a place: turns, places on the way, and the place.
std::vector<RouteStop> route_to(const Gate& gate, dvec2 from, int slot) {
  const std::vector<RouteStop> stops = route_stops(gate, from);
  const std::size_t goal = static_cast<std::size_t>(slot) + 1;
  std::vector<double> length(stops.size(), HUGE_VAL);
  std::vector<std::size_t> before(stops.size(), 0);
  std::vector<bool> is_final(stops.size(), false);
  length[0] = 0.0;
  for (std::size_t round = 0; round < stops.size(); ++round) {
    std::size_t here = stops.size();
    for (std::size_t i = 0; i < stops.size(); ++i)
      if (!is_final[i] && (here == stops.size() || length[i] < length[here])) here = i;
    is_final[here] = true;
    for (std::size_t next = 0; next < stops.size(); ++next) {
      const double reached = length[here] + glm::distance(stops[here].at, stops[next].at);
      if (is_final[next] || reached >= length[next] || !leads_straight(gate, stops[here].at, stops[next].at)) continue;
      length[next] = reached;
      before[next] = here;
    }
  }
  std::vector<RouteStop> route{stops[goal]};
  for (std::size_t i = before[goal]; i != 0; i = before[i]) route.push_back(stops[i]);
  std::reverse(route.begin(), route.end());
  return route;
}

bool needs_hold(const Gate& gate, LockoutKind kind, int left, const std::vector<RouteStop>& route) {
  const auto all = lockouts(gate);
  return std::any_of(all.begin(), all.end(), [&](const Lockout& lockout) {
    if (lockout.kind != kind) return false;
    if (lockout.is_leaving && lockout.slot == left) return true;
    return std::any_of(route.begin(), route.end(), [&](const RouteStop& stop) { return stop.slot == lockout.slot; });
  });
}

// At each stop, the hand pushes against the springs; in the middle of a place, these are all that acts. It also waits at
// turns for as long as in a gear, because the detent of a place that it just left may throw the lever past the turn.
void shift_through_aisles(const Gate& gate, int slot, const ShiftStyle& style, StrokeWriter& writer) {
  const std::vector<RouteStop> route = route_to(gate, writer.at(), slot);
  const int left = slot_at(gate, writer.at());
  writer.hold(needs_hold(gate, LockoutKind::push_down, left, route), needs_hold(gate, LockoutKind::lift, left, route));
  for (const RouteStop& stop : route) writer.move_to(stop.at, style.dwell_gear, -gate_feel(gate, stop.at));
  writer.hold(false, false);
}

std::vector<int> tour_of_places(const Gate& gate) {
  std::vector<int> order;
  dvec2 at = rest_position(gate, kNeutralGear);
  for (int i = 0; i < gate.slot_count; ++i) {
    if (slot_of(gate, i).gear == kNeutralGear || glm::distance(at, slot_of(gate, i).at) < kOnLine) continue;
    for (const RouteStop& stop : route_to(gate, at, i))
      if (stop.slot != kNoSlot && slot_of(gate, stop.slot).gear != kNeutralGear)
        order.push_back(slot_of(gate, stop.slot).gear);
    at = slot_of(gate, i).at;
  }
  return order;
}

// A gear that is open only after others: the hand goes through the nearest of these.
std::vector<int> with_gears_before(const Gate& gate, std::span<const int> gears, int engaged) {
  std::vector<int> all;
  for (const int next : gears) {
    for (const Lockout& lockout : lockouts(gate)) {
      const bool applies = lockout.kind == LockoutKind::only_after && slot_of(gate, lockout.slot).gear == next;
      if (!applies || engaged == next || includes_gear(lockout.only_after, engaged)) continue;
      int nearest = kMaxGateGear;
      while (!includes_gear(lockout.only_after, nearest)) --nearest;
      all.push_back(nearest);
    }
    all.push_back(next);
    engaged = next;
  }
  return all;
}

}  // namespace

std::vector<HandStroke> shift_strokes(const Gate& gate, dvec2 start, std::span<const int> gears,
                                      const ShiftStyle& style) {
  StrokeWriter writer(start, style);
  const auto select = [&](double x) {
    const double direction = x - writer.at().x;
    if (std::abs(direction) <= column_at(gate, x).half_width + 1.01 * kLean) return;  // already in the right column
    writer.move_to({x + (style.leans ? lean_at(gate, x, direction) : 0.0), 0.0}, style.dwell_neutral);
  };
  int gear = style.engaged;
  for (const int next : with_gears_before(gate, gears, gear)) {
    const int index = slot_of_gear(gate, next);
    if (is_mechanism(gate)) {
      shift_through_aisles(gate, index, style, writer);
      continue;
    }
    const dvec2 rest = rest_position(gate, next);
    if (slot_at(gate, writer.at()) != kNoSlot) writer.move_to({writer.at().x, 0.0}, style.dwell_neutral);
    if (is_sequential(gate)) {
      gear = shift_in_sequence(gate, gear, next, style, writer);
      continue;
    }
    if (has_lockout(gate, index, LockoutKind::after_gear, gear)) {
      writer.move_to({detour_x(gate, rest.x), 0.0}, style.dwell_neutral);
    }
    writer.hold(has_lockout(gate, index, LockoutKind::push_down, gear),
                has_lockout(gate, index, LockoutKind::lift, gear));
    select(rest.x);
    if (index != kNoSlot) {
      const Slot& slot = gate.slot[static_cast<std::size_t>(index)];
      const double depth = style.leans ? slot.end + kLean : slot.rest;
      writer.move_to({writer.at().x, static_cast<int>(slot.side) * depth}, style.dwell_gear);
    }
    writer.hold(false, false);
    gear = next;
  }
  return writer.take();
}

std::vector<int> tour_order(const Gate& gate) {
  if (is_mechanism(gate)) return tour_of_places(gate);
  std::vector<int> order;
  if (is_sequential(gate)) {
    for (int gear = 1; gear <= gate.sequential_gears; ++gear) order.push_back(gear);
    for (int gear = gate.sequential_gears - 1; gear >= kReverseGear; --gear)
      if (gear != kNeutralGear) order.push_back(gear);
    return order;
  }
  order.reserve(static_cast<std::size_t>(gate.slot_count));
  for (const Slot& slot : slots(gate)) order.push_back(slot.gear);
  std::sort(order.begin(), order.end());
  if (!order.empty() && order.front() == kReverseGear) std::rotate(order.begin(), order.begin() + 1, order.end());
  return order;
}

ScriptedHandConfig touring_hand(dvec2 start) {
  ScriptedHandConfig hand;
  hand.start = start;
  hand.effort_gain = 4000.0;
  hand.effort_limit = 25.0;
  return hand;
}

}  // namespace gearshift::haptics
