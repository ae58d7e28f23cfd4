#include "haptics/gate/gate.h"

#include <cmath>
#include <cstddef>

namespace gearshift {

int nearest_column(const Gate& gate, double x) noexcept {
  int nearest = 0;
  for (int i = 1; i < gate.column_count; ++i) {
    const double rival = std::abs(gate.column[static_cast<std::size_t>(i)].center - x);
    if (rival < std::abs(gate.column[static_cast<std::size_t>(nearest)].center - x)) nearest = i;
  }
  return nearest;
}

int slot_of_gear(const Gate& gate, int gear) noexcept {
  for (int i = 0; i < gate.slot_count; ++i) {
    if (gate.slot[static_cast<std::size_t>(i)].gear == gear) return i;
  }
  return kNoSlot;
}

glm::dvec2 rest_position(const Gate& gate, int gear) noexcept {
  const int index = slot_of_gear(gate, gear);
  if (index == kNoSlot) return {gate.column[static_cast<std::size_t>(gate.neutral_column)].center, 0.0};
  const Slot& slot = gate.slot[static_cast<std::size_t>(index)];
  return {gate.column[static_cast<std::size_t>(slot.column)].center, static_cast<int>(slot.side) * slot.rest};
}

const char* gear_name(int gear) noexcept {
  static constexpr const char* kNames[] = {"R", "N", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
  return gear >= kReverseGear && gear <= 9 ? kNames[gear - kReverseGear] : "?";
}

bool in_free_space(const Gate& gate, glm::dvec2 point, double slack) noexcept {
  const double across = std::abs(point.y);
  if (across <= gate.half_aisle + slack) {
    if (point.x >= gate.select_min - slack && point.x <= gate.select_max + slack) return true;
  }
  const Column& column = gate.column[static_cast<std::size_t>(nearest_column(gate, point.x))];
  if (point.y < column.back - slack || point.y > column.forward + slack) return false;
  const double off = std::abs(point.x - column.center) - column.half_width;
  if (off <= slack) return true;
  const bool is_end_wall = point.x < gate.select_min - slack || point.x > gate.select_max + slack;
  return !is_end_wall && off + (across - gate.half_aisle) <= gate.chamfer + slack;
}

}  // namespace gearshift
