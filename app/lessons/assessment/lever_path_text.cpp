#include "app/lessons/assessment/lever_path_text.h"

#include <algorithm>
#include <array>

namespace gearshift::lessons {
namespace {

// Position of a gear in the gate. Neutral is in the column that the spring pulls the lever to.
struct Place {
  int column = 0;
  int side = 0;  // -1: back, 0: neutral, +1: forward
};

Place place_of(const haptics::Gate& gate, int gear) noexcept {
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

// Describes the sideways motion in neutral. The spring, if there is one, pulls towards the neutral column and resists
// motion away from it.
std::string across(const haptics::Gate& gate, int from, int to) {
  const bool has_spring = haptics::feel_force(gate.select_feel, gate.select_max) != 0.0;
  if (!has_spring) return to > from ? "to the right" : "to the left";
  if (to == gate.neutral_column) return "let the spring pull the lever across";
  const std::string side = to > from ? "right" : "left";
  const bool against = to > from ? to > gate.neutral_column : to < gate.neutral_column;
  return (against ? "to the " + side + " against the spring" : "a little to the " + side);
}

}  // namespace

std::string describe_lever_path(const haptics::Gate& gate, int from, int to) {
  const Place begin = place_of(gate, from), end = place_of(gate, to);
  std::string text;
  const auto then = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (end.side == 0) return "Pull the lever into neutral and let go.";
  const std::string in = end.side > 0 ? "forward" : "back";
  if (begin.column != end.column) {
    if (begin.side != 0) then("into neutral");
    then(across(gate, begin.column, end.column));
    then("then " + in);
  } else {
    text = begin.side == -end.side ? "straight " + in : in;
  }
  if (is_locked(gate, to, haptics::LockoutKind::lift)) text = "lift the ring: " + text;
  if (is_locked(gate, to, haptics::LockoutKind::push_down)) text = "hold the knob down: " + text;
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text + ".";
}

std::string gear_word(int gear) {
  static constexpr std::array kWords{"reverse", "neutral", "first", "second", "third", "fourth", "fifth", "sixth"};
  const auto index = static_cast<std::size_t>(gear - haptics::kReverseGear);
  return index < kWords.size() ? kWords[index] : std::string("gear ") + haptics::gear_name(gear);
}

}  // namespace gearshift::lessons
