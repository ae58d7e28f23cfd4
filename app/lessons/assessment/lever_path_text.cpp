#include "app/lessons/assessment/lever_path_text.h"

#include <algorithm>

namespace gearshift::lessons {
namespace {

// Position of a gear. Neutral is in the column that the spring leads to.
struct Place {
  int column = 0;
  int side = 0;  // -1 back, 0 aisle, +1 forward
};

Place resolve_path(const haptics::Gate& gate, int gear) noexcept {
  if (gear == haptics::kNeutralGear) return {gate.neutral_column, 0};
  const haptics::Slot& slot = haptics::slot_of(gate, haptics::slot_of_gear(gate, gear));
  return {slot.column, static_cast<int>(slot.side)};
}

bool is_locked(const haptics::Gate& gate, int gear, haptics::LockoutKind kind) noexcept {
  return std::any_of(haptics::lockouts(gate).begin(), haptics::lockouts(gate).end(),
                     [&](const haptics::Lockout& lockout) {
                       return lockout.kind == kind && haptics::slot_of(gate, lockout.slot).gear == gear;
                     });
}

// The spring pulls towards its own column and resists every motion away from it.
std::string across(const haptics::Gate& gate, int from, int to) {
  if (to == gate.neutral_column) return "let the spring take it across";
  const std::string side = to > from ? "right" : "left";
  const bool against = to > from ? to > gate.neutral_column : to < gate.neutral_column;
  return against ? side + " against the spring" : "a little " + side;
}

}  // namespace

std::string describe_lever_path(const haptics::Gate& gate, int from, int to) {
  const Place begin = resolve_path(gate, from), end = resolve_path(gate, to);
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
  if (is_locked(gate, to, haptics::LockoutKind::lift)) way = "lift the ring, " + way;
  if (is_locked(gate, to, haptics::LockoutKind::push_down)) way = "push the knob down, " + way;
  way[0] = static_cast<char>(way[0] - 'a' + 'A');
  return way + ".";
}

}  // namespace gearshift::lessons
