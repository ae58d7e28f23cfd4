#include "app/vehicle/shift_drum.h"

#include <algorithm>

namespace gearshift::vehicle {

haptics::Gate sleeves_of(const haptics::Gate& gate) noexcept {
  if (!haptics::is_sequential(gate)) return gate;
  haptics::Gate sleeves = gate;
  sleeves.slot_count = 0;
  for (int gear = haptics::kReverseGear; gear <= gate.sequential_gears; ++gear) {
    if (gear == haptics::kNeutralGear) continue;
    haptics::Slot& slot = sleeves.slot[static_cast<std::size_t>(sleeves.slot_count++)];
    slot = gate.slot[0];
    slot.gear = gear;
  }
  return sleeves;
}

ShiftDrum::ShiftDrum(const haptics::Gate& gate) noexcept
    : gate_(gate),
      sleeves_(sleeves_of(gate)),
      mouth_(gate.half_aisle + gate.chamfer),
      crest_(gate.slot[0].release_depth),
      rest_(gate.slot[0].rest) {}

// A neutral drum has no sleeve in a gear.
int ShiftDrum::sleeve_of(int gear) const noexcept {
  return gear == haptics::kNeutralGear ? haptics::kNoSlot : haptics::slot_of_gear(sleeves_, gear);
}

ShiftDrum::Sleeve ShiftDrum::seated(int gear) const noexcept {
  return {sleeve_of(gear), rest_, 0.0};
}

ShiftDrum::Sleeve ShiftDrum::turn(const haptics::LeverInput& lever) noexcept {
  if (!haptics::is_sequential(gate_)) return {lever.slot, lever.depth, 1.0};
  if (lever.slot != stroke_slot_) {
    stroke_slot_ = lever.slot;
    from_ = to_ = lever.gear;
    if (lever.slot != haptics::kNoSlot) to_ = haptics::gear_behind(gate_, lever.slot, from_);
  }
  const bool is_stroke = to_ != from_ && lever.gear == from_;
  if (!is_stroke) return seated(lever.gear);
  if (lever.depth >= crest_) return {sleeve_of(to_), lever.depth, 1.0};
  const double fraction = std::clamp((lever.depth - mouth_) / (crest_ - mouth_), 0.0, 1.0);
  return {sleeve_of(from_), rest_ - fraction * (rest_ - crest_), -1.0};
}

double ShiftDrum::lever_depth(double depth) const noexcept {
  return mouth_ + (rest_ - depth) / (rest_ - crest_) * (crest_ - mouth_);
}

}  // namespace gearshift::vehicle
