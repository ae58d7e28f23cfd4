#include "app/ui/input/gear_hand.h"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/geometric.hpp>

#include "haptics/gate/lockout.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::ui {
namespace {

constexpr double kPeriod = 1e-3;       // [s] step of the scripted hand, whose effort depends on it
constexpr double kPace = 0.6;          // [m/s] the shifter's own lever has already arrived, so the hand hurries
constexpr double kReaction = 0.03;     // [s] added to each stroke
constexpr double kNeutralDelay = 0.3;  // [s] a shift through neutral takes less; then the lever stays in its column
constexpr double kCornerTolerance = 0.004;  // [m] distance at which the lever counts as arrived at a stroke's end
constexpr double kCornerWait = 0.4;         // [s] longest wait for it; a wall may keep the lever away
// [s] the same in a sequential gate, where the lever returns and must be in the gear before
constexpr double kStrokeWait = 1.5;
constexpr double kRestAfter = 0.2;    // [s] after the end of the movement, if the lever is in the gear
constexpr double kMissedAfter = 1.5;  // [s] after its end; a synchroniser needs less: down into first 1.1 s

}  // namespace

void GearHand::set_gate(const haptics::Gate& gate) {
  gate_ = gate;
  release();
}

void GearHand::shift(int gear, int engaged, glm::dvec2 lever, bool opens_lockouts) {
  if (!gate_) return;
  const bool is_neutral = gear == haptics::kNeutralGear;
  const haptics::ShiftStyle style{.pace = kPace,
                                  .reaction = kReaction,
                                  .dwell_gear = 0.0,
                                  .dwell_neutral = is_neutral ? kNeutralDelay : 0.0,
                                  .leans = false,
                                  .engaged = engaged,
                                  .opens_lockouts = opens_lockouts};
  gear_ = gear;
  opens_lockouts_ = opens_lockouts;
  time_ = 0.0;
  is_resting_ = false;
  waited_ = 0.0;
  corners_.clear();
  const bool exists = haptics::has_gear(*gate_, gear);
  std::vector<haptics::HandStroke> strokes;
  if (exists) strokes = haptics::shift_strokes(*gate_, lever, std::array{gear}, style);
  // A shifter passes neutral on its way. In a sequential gate, a stroke towards neutral would change the gear at once.
  if (is_neutral && opens_lockouts && haptics::is_sequential(*gate_) && !strokes.empty())
    strokes.insert(strokes.begin(), {lever, kNeutralDelay, 0.0, {}, false, false});
  double end = 0.0;
  for (const haptics::HandStroke& stroke : strokes) {
    corners_.push_back({end + stroke.duration, stroke.to});
    end += stroke.duration + stroke.dwell;
  }
  hand_.emplace(haptics::touring_hand(lever), std::move(strokes), kPeriod);
}

void GearHand::shift_by(int gears, int engaged, glm::dvec2 lever) {
  if (!gate_) return;
  const int from = is_moving() ? gear_ : engaged;
  const int to = from + gears;
  if (haptics::has_gear(*gate_, to)) shift(to, engaged, lever, !haptics::is_sequential(*gate_));
}

void GearHand::try_again(int engaged, glm::dvec2 lever) {
  if (!gate_) return;
  const auto lockouts = haptics::lockouts(*gate_);
  const bool is_locked = std::any_of(lockouts.begin(), lockouts.end(), [&](const haptics::Lockout& lockout) {
    const bool stands = lockout.from_gear == haptics::kAnyGear || lockout.from_gear == engaged;
    return stands && haptics::locked_gear(*gate_, lockout) == gear_;
  });
  if (opens_lockouts_ || !is_locked) shift(gear_, engaged, lever, opens_lockouts_);
}

haptics::HandTarget GearHand::next(double seconds, glm::dvec2 lever, int engaged) {
  is_resting_ = is_resting_ || (time_ > hand_->duration() + kRestAfter && engaged == gear_);
  if (is_resting_ || !is_moving()) {
    haptics::HandTarget rest;
    rest.position = lever;
    return rest;
  }
  double end = time_ + seconds;
  if (!corners_.empty() && end >= corners_.front().end) {
    waited_ += seconds;
    const bool has_arrived = glm::distance(lever, corners_.front().at) < kCornerTolerance;
    const double wait = haptics::is_sequential(*gate_) ? kStrokeWait : kCornerWait;
    if (time_ >= corners_.front().end - kPeriod && (has_arrived || waited_ > wait)) {
      corners_.erase(corners_.begin());
      waited_ = 0.0;
    }
    if (!corners_.empty()) end = std::min(end, corners_.front().end);
  }
  haptics::HandTarget target = hand_->next(time_, lever);
  while (time_ + kPeriod <= end) target = hand_->next(time_ += kPeriod, lever);
  return target;
}

bool GearHand::is_moving() const {
  return is_active() && !is_resting_ && time_ <= hand_->duration() + kMissedAfter;
}

}  // namespace gearshift::ui
