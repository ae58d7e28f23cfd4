#include "haptics/gate/lockout.h"

#include <algorithm>
#include <cmath>

#include "haptics/files/number_text.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::haptics {
namespace {

constexpr double kSideTolerance = 1e-9;  // [m] tolerance for rounding at the sides of a slot

bool is_past_mouth(const Gate& gate, const Slot& slot, glm::dvec2 proxy) noexcept {
  const Column& column = column_of(gate, slot.column);
  const bool in_slot = std::abs(proxy.x - column.center) <= column.half_width + gate.chamfer + kSideTolerance;
  return in_slot && static_cast<int>(slot.side) * proxy.y > gate.half_aisle + gate.chamfer;
}

bool is_beyond(const Gate& gate, const Lockout& lockout, glm::dvec2 proxy) noexcept {
  if (lockout.lateral) return lockout.beyond * (proxy.x - lockout.barrier) > 0.0;
  return is_past_mouth(gate, slot_of(gate, lockout.slot), proxy);
}

// The shift drum does not turn beyond its first and last gear.
void close_ends(const Gate& gate, int engaged, glm::dvec2 proxy, Passage& passage) noexcept {
  for (int i = 0; i < gate.slot_count; ++i) {
    const bool ends = gear_behind(gate, i, engaged) == engaged;
    if (ends && !is_past_mouth(gate, slot_of(gate, i), proxy)) passage.closed |= 1u << i;
  }
}

bool has_left_column(const Gate& gate, int gear, glm::dvec2 proxy) noexcept {
  const int slot = slot_of_gear(gate, gear);
  if (slot == kNoSlot) return true;
  const Column& column = column_of(gate, slot_of(gate, slot).column);
  return std::abs(proxy.x - column.center) > column.half_width + gate.chamfer + kSideTolerance;
}

// New state of a latching lockout: true if closed, for `only_after` true if open. Between the two thresholds the state
// is unchanged.
bool is_latched(const Gate& gate, const Lockout& lockout, const LockoutInputs& in, glm::dvec2 proxy,
                bool was_latched) noexcept {
  if (lockout.kind == LockoutKind::speed) {
    const double speed = std::abs(in.road_speed);  // a speed of NaN leaves the state unchanged
    return was_latched ? !(speed < lockout.open_below) : speed > lockout.close_above;
  }
  if (lockout.kind == LockoutKind::only_after) {
    if (in.gear == kNeutralGear || in.gear == slot_of(gate, lockout.slot).gear) return was_latched;
    return includes_gear(lockout.only_after, in.gear);
  }
  if (in.gear == lockout.after_gear) return true;
  return was_latched && !has_left_column(gate, lockout.after_gear, proxy);
}

bool is_locked(const Lockout& lockout, const LockoutInputs& in, bool latched) noexcept {
  switch (lockout.kind) {
    case LockoutKind::push_down:
      return !in.pressed_down;
    case LockoutKind::lift:
      return !in.lifted;
    case LockoutKind::speed:
    case LockoutKind::after_gear:
      return latched;
    case LockoutKind::only_after:
      return !latched;
    case LockoutKind::brake:
      return !(in.brake >= kBrakePressed);
  }
  return true;
}

// True if the proxy is in aisles, but in none of the parts that the passage leaves open. A lever that presses on the
// lockout's wall is on a part's edge, except for rounding.
bool is_outside_open_part(const Gate& gate, const Passage& passage, glm::dvec2 proxy) noexcept {
  bool is_in_aisle = false;
  for (int i = 0; i < gate.aisle_count; ++i) {
    if (!contains(whole(gate.aisle[static_cast<std::size_t>(i)]), proxy, kSideTolerance)) continue;
    if (contains(open_part(gate, passage, i, proxy), proxy, kSideTolerance)) return false;
    is_in_aisle = true;
  }
  return is_in_aisle;
}

// A place's lockout does not close while the lever is beyond it: inside the place, or, if the lever may not leave the
// place, not yet deep enough in it.
void add_place_to_passage(const Gate& gate, const Lockout& lockout, glm::dvec2 proxy, Passage& passage) noexcept {
  if (lockout.is_leaving && slot_at(gate, proxy) != lockout.slot) return;
  Passage only = open_passage(gate);
  if (lockout.is_leaving)
    only.held_slot = lockout.slot;
  else
    only.closed = 1u << lockout.slot;
  if (is_outside_open_part(gate, only, proxy)) return;
  if (lockout.is_leaving)
    passage.held_slot = lockout.slot;
  else
    passage.closed |= only.closed;
}

bool is_latching(LockoutKind kind) noexcept {
  return kind == LockoutKind::speed || kind == LockoutKind::after_gear || kind == LockoutKind::only_after;
}

void add_to_passage(const Lockout& lockout, Passage& passage) noexcept {
  if (!lockout.lateral) {
    passage.closed |= 1u << lockout.slot;
  } else if (lockout.beyond > 0) {
    passage.select_max = std::fmin(passage.select_max, lockout.barrier);
  } else {
    passage.select_min = std::fmax(passage.select_min, lockout.barrier);
  }
}

}  // namespace

Passage open_passage(const Gate& gate) noexcept {
  Passage passage;
  passage.select_min = gate.select_min;
  passage.select_max = gate.select_max;
  return passage;
}

Passage Lockouts::update(const Gate& gate, const LockoutInputs& in, glm::dvec2 proxy) noexcept {
  Passage passage = open_passage(gate);
  std::uint32_t bit = 1u;  // bit of the current lockout in latched_
  for (const Lockout& lockout : lockouts(gate)) {
    if (is_latching(lockout.kind)) {
      latched_ = is_latched(gate, lockout, in, proxy, latched_ & bit) ? latched_ | bit : latched_ & ~bit;
    }
    const bool applies = lockout.from_gear == kAnyGear || lockout.from_gear == in.gear;
    if (applies && is_locked(lockout, in, latched_ & bit)) {
      if (is_mechanism(gate))
        add_place_to_passage(gate, lockout, proxy, passage);
      else if (!is_beyond(gate, lockout, proxy))
        add_to_passage(lockout, passage);
    }
    bit <<= 1;
  }
  if (is_sequential(gate)) close_ends(gate, in.gear, proxy, passage);
  return passage;
}

bool has_brake_lockout(const Gate& gate) noexcept {
  const auto all = lockouts(gate);
  return std::any_of(all.begin(), all.end(), [](const Lockout& lockout) { return lockout.kind == LockoutKind::brake; });
}

int locked_gear(const Gate& gate, const Lockout& lockout) noexcept {
  const int engaged = lockout.from_gear == kAnyGear ? kNeutralGear : lockout.from_gear;
  return gear_behind(gate, lockout.slot, engaged);
}

std::string describe(const Lockout& lockout) {
  switch (lockout.kind) {
    case LockoutKind::brake:
      return "open while the brake is pressed";
    case LockoutKind::push_down:
      return "open while the knob is pushed down";
    case LockoutKind::lift:
      return "open while the ring is lifted";
    case LockoutKind::speed:
      return "closed above " + number_text(lockout.close_above * kKmhPerMps, 3) + ", open below " +
             number_text(lockout.open_below * kKmhPerMps, 3) + " km/h";
    case LockoutKind::after_gear:
      return std::string("closed for a direct shift from ") + gear_name(lockout.after_gear);
    case LockoutKind::only_after: {
      std::string gears;
      for (int gear = kReverseGear; gear <= kMaxGateGear; ++gear) {
        if (includes_gear(lockout.only_after, gear))
          gears += (gears.empty() ? "" : " or ") + std::string(gear_name(gear));
      }
      return "open only after " + gears;
    }
  }
  return "?";
}

}  // namespace gearshift::haptics
