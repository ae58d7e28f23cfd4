#include "app/training/lever_way.h"

#include <algorithm>

namespace gearshift {
namespace {

// Where a gear lies; neutral in the column to which the spring leads.
struct Place {
  int column = 0;
  int side = 0;  // -1 back, 0 the aisle, +1 forward
};

Place place_of(const Gate& gate, int gear) noexcept {
  if (gear == kNeutralGear) return {gate.neutral_column, 0};
  const Slot& slot = slot_of(gate, slot_of_gear(gate, gear));
  return {slot.column, static_cast<int>(slot.side)};
}

bool is_locked(const Gate& gate, int gear, LockoutKind kind) noexcept {
  return std::any_of(lockouts(gate).begin(), lockouts(gate).end(), [&](const Lockout& lockout) {
    return lockout.kind == kind && slot_of(gate, lockout.slot).gear == gear;
  });
}

// The spring draws to its own column and resists every way from it.
std::string across(const Gate& gate, int from, int to) {
  if (to == gate.neutral_column) return "let the spring take it across";
  const std::string side = to > from ? "right" : "left";
  const bool against = to > from ? to > gate.neutral_column : to < gate.neutral_column;
  return against ? side + " against the spring" : "a little " + side;
}

}  // namespace

std::string lever_way(const Gate& gate, int from, int to) {
  const Place begin = place_of(gate, from), end = place_of(gate, to);
  std::string way;
  const auto then = [&](const std::string& words) { way += (way.empty() ? "" : ", ") + words; };
  if (end.side == 0) return "Into the aisle, and let go.";
  const std::string in = end.side > 0 ? "forward" : "back";
  if (begin.column != end.column) {
    if (begin.side != 0) then("into the aisle");
    then(across(gate, begin.column, end.column));
    then("then " + in);
  } else {
    way = begin.side == -end.side ? "straight " + in : in;
  }
  if (is_locked(gate, to, LockoutKind::lift)) way = "lift the ring, " + way;
  if (is_locked(gate, to, LockoutKind::push_down)) way = "push the knob down, " + way;
  way[0] = static_cast<char>(way[0] - 'a' + 'A');
  return way + ".";
}

}  // namespace gearshift
