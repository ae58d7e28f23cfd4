#include "haptics/gate/gate.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "haptics/gate/aisle.h"

namespace gearshift::haptics {

bool has_gear(const Gate& gate, int gear) noexcept {
  if (is_sequential(gate)) return gear >= kReverseGear && gear <= gate.sequential_gears;
  return gear == kNeutralGear || slot_of_gear(gate, gear) != kNoSlot;
}

int gear_behind(const Gate& gate, int slot, int engaged) noexcept {
  const int gear = slot_of(gate, slot).gear;
  if (!is_sequential(gate)) return gear;
  const int next = engaged + (gear == kNextGear ? 1 : -1);
  return has_gear(gate, next) ? next : engaged;
}

int slot_of_gear(const Gate& gate, int gear) noexcept {
  for (int i = 0; i < gate.slot_count; ++i) {
    if (slot_of(gate, i).gear == gear) return i;
  }
  return kNoSlot;
}

glm::dvec2 rest_position(const Gate& gate, int gear) noexcept {
  const int index = slot_of_gear(gate, gear);
  if (index == kNoSlot) return {column_of(gate, gate.neutral_column).center, 0.0};
  return slot_of(gate, index).at;
}

const char* gear_name(int gear) noexcept {
  if (gear == kNextGear) return "+";
  if (gear == kPreviousGear) return "-";
  static constexpr const char* kNames[] = {"R", "N",  "1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",
                                           "9", "10", "11", "12", "13", "14", "15", "16", "17", "18"};
  static_assert(std::size(kNames) == kMaxGateGear - kReverseGear + 1);
  return gear >= kReverseGear && gear <= kMaxGateGear ? kNames[gear - kReverseGear] : "?";
}

const char* gear_label(const Gate& gate, int gear) noexcept {
  const int slot = slot_of_gear(gate, gear);
  const bool has_label = slot != kNoSlot && slot_of(gate, slot).label[0] != '\0';
  return has_label ? slot_of(gate, slot).label.data() : gear_name(gear);
}

const char* to_string(Side side) noexcept {
  return side == Side::forward ? "forward" : "back";
}

const char* to_string(LockoutKind kind) noexcept {
  switch (kind) {
    case LockoutKind::push_down:
      return "push_down";
    case LockoutKind::lift:
      return "lift";
    case LockoutKind::speed:
      return "speed";
    case LockoutKind::after_gear:
      return "after_gear";
    case LockoutKind::only_after:
      return "only_after";
    case LockoutKind::brake:
      return "brake";
  }
  return "?";
}

bool in_free_space(const Gate& gate, glm::dvec2 point, double slack) noexcept {
  if (is_mechanism(gate)) {
    const auto all = aisles(gate);
    return std::any_of(all.begin(), all.end(),
                       [&](const Aisle& aisle) { return distance_to(aisle, point) <= aisle.half_width + slack; });
  }
  const double across = std::abs(point.y);
  if (across <= gate.half_aisle + slack) {
    if (point.x >= gate.select_min - slack && point.x <= gate.select_max + slack) return true;
  }
  const Column& column = column_of(gate, nearest_column(gate, point.x));
  if (point.y < column.back - slack || point.y > column.forward + slack) return false;
  const double off = std::abs(point.x - column.center) - column.half_width;
  if (off <= slack) return true;
  const bool is_end_wall = point.x < gate.select_min - slack || point.x > gate.select_max + slack;
  return !is_end_wall && off + (across - gate.half_aisle) <= gate.chamfer + slack;
}

}  // namespace gearshift::haptics
