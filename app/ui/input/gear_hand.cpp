#include "app/ui/input/gear_hand.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/gate/gate_feel.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::ui {
namespace {

constexpr double kPeriod = 1e-3;       // [s] step of the scripted hand, whose effort depends on it
constexpr double kPace = 0.6;          // [m/s] the shifter's own lever has already arrived, so the hand hurries
constexpr double kReaction = 0.03;     // [s] added to each stroke
constexpr double kNeutralDelay = 0.3;  // [s] a shift through neutral takes less; then the lever stays in its column
constexpr double kRestAfter = 0.2;     // [s] after the end of the movement, if the lever is in the gear
constexpr double kMissedAfter =
    0.7;  // [s] after the end of the movement; a synchroniser needs less with the clutch open

}  // namespace

void GearHand::set_gate(const haptics::Gate& gate) {
  gate_ = gate;
  release();
}

void GearHand::shift_to(int gear, glm::dvec2 lever) {
  if (!gate_) return;
  const bool is_neutral = gear == haptics::kNeutralGear;
  const haptics::ShiftStyle style{.pace = kPace,
                                  .reaction = kReaction,
                                  .dwell_gear = 0.0,
                                  .dwell_neutral = is_neutral ? kNeutralDelay : 0.0,
                                  .leans = false};
  gear_ = gear;
  time_ = 0.0;
  is_resting_ = false;
  const bool exists = is_neutral || haptics::slot_of_gear(*gate_, gear) != haptics::kNoSlot;
  hand_.emplace(
      haptics::touring_hand(lever),
      exists ? haptics::shift_strokes(*gate_, lever, std::array{gear}, style) : std::vector<haptics::HandStroke>{},
      kPeriod);
}

void GearHand::shift_by(int gears, glm::dvec2 lever) {
  if (!gate_) return;
  const int from = is_active() ? gear_ : gear_of(lever);
  const int to = from + gears;
  const bool exists = to == haptics::kNeutralGear || haptics::slot_of_gear(*gate_, to) != haptics::kNoSlot;
  if (exists) shift_to(to, lever);
}

haptics::HandTarget GearHand::next(double seconds, glm::dvec2 lever) {
  is_resting_ = is_resting_ || (time_ > hand_->duration() + kRestAfter && gear_of(lever) == gear_);
  if (is_resting_) {
    haptics::HandTarget rest;
    rest.position = lever;
    return rest;
  }
  haptics::HandTarget target = hand_->next(time_, lever);
  for (const double end = time_ + seconds; time_ + kPeriod <= end;) target = hand_->next(time_ += kPeriod, lever);
  return target;
}

int GearHand::gear_of(glm::dvec2 lever) const {
  const int index = gate_ ? haptics::slot_at(*gate_, lever) : haptics::kNoSlot;
  if (index == haptics::kNoSlot) return haptics::kNeutralGear;
  const haptics::Slot& slot = haptics::slot_of(*gate_, index);
  return std::abs(lever.y) >= slot.engage_depth ? slot.gear : haptics::kNeutralGear;
}

bool GearHand::is_moving() const {
  return is_active() && !is_resting_ && time_ <= hand_->duration() + kMissedAfter;
}

}  // namespace gearshift::ui
