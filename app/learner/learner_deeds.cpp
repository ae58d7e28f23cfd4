// What is done wrong on purpose, apart from what spoils a shift.
#include <algorithm>
#include <cmath>

#include "app/learner/learner_habits.h"
#include "app/learner/simulated_learner.h"

namespace gearshift {

// Something that spoils a launch is still to be done.
bool SimulatedLearner::means_ill(const DriveSample& now) const noexcept {
  if (now.car.gear == kNeutralGear) return false;
  const bool hill = std::abs(lesson_.start.slope) > kHill;
  return (hill && is_due(FaultKind::rollback)) || is_due(FaultKind::stall) || is_due(FaultKind::clutch_dump) ||
         is_due(FaultKind::jerk);
}

// At a launch: true while the deed is being done.
bool SimulatedLearner::spoils_launch(const DriveSample& now) {
  if (!means_ill(now)) return false;
  const bool dumps = is_due(FaultKind::clutch_dump);
  const double revs = dumps ? kDumpSpeed : kJerkSpeed;
  if (feet_.hand_brake.value() > 0.05 && !is_due(FaultKind::rollback) && !is_due(FaultKind::stall)) {
    // On a hill the revs come first, or it would roll back.
    feet_.throttle.go(kHurry, 4.0);
    if (now.car.engine_speed >= revs) feet_.hand_brake.go(0.0, kHandBrakeRate);
    return true;
  }
  if (feet_.hand_brake.value() > 0.05) {
    if (intent().motion == Motion::bite) feet_.hand_brake.go(0.0, kHandBrakeRate);  // it is not waited for
    hold_revs(launch_speed_);
    feet_.clutch.go(0.5 * (car_.clutch.bite + kClutchDown), kToBite);
    rolls_since_ = now.time();
    return true;
  }
  if (is_due(FaultKind::rollback)) {
    hold_revs(launch_speed_);
    const bool rolls = now.time() - rolls_since_ < 0.8 * faults_.of(FaultKind::rollback);
    if (!rolls) once(FaultKind::rollback);
    return rolls;
  }
  if (is_due(FaultKind::stall)) {
    feet_.throttle.go(0.0, kLiftRate);
    feet_.clutch.go(0.0, 3.0);
    return true;
  }
  feet_.throttle.go(kHurry, 4.0);
  const bool comes_up = feet_.clutch.goal() == 0.0 && feet_.clutch.value() < car_.clutch.bite;
  if (now.car.engine_speed >= revs || comes_up) feet_.clutch.go(0.0, dumps ? kFootOff : kAbrupt);
  if (feet_.clutch.value() == 0.0) once(dumps ? FaultKind::clutch_dump : FaultKind::jerk);
  return true;
}

bool SimulatedLearner::over_revs(const DriveSample& now) {
  if (!is_due(FaultKind::over_rev) || !now.car.running) return false;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  const bool late = over_rev_late_ && coupled && now.car.gear >= 1 && now.car.gear <= 2;
  const bool stands = std::abs(now.car.road_speed) < kStill;
  const bool howls = !over_rev_late_ && clutch_is_down_ && (stands || feet_.brake.goal() < 0.5);
  if (!late && !howls) return false;
  feet_.throttle.go(1.0, 8.0);
  if (now.car.engine_speed > 1.01 * car_.engine.red_line && once(FaultKind::over_rev) && howls)
    release_at_ = now.time() + kRevsSettle;
  return true;
}

// The highest gear in which the engine would labour at this speed, if it is none lower.
int SimulatedLearner::lugging_gear(const DriveSample& now) const noexcept {
  for (int gear = kMaxGear; gear >= std::max(1, now.car.gear); --gear) {
    if (slot_of_gear(gate_, gear) == kNoSlot) continue;
    const double speed = asked(now, gear);
    if (speed < 0.95 * car_.engine.lug_below && speed > 1.25 * car_.engine.stall) return gear;
  }
  return kNeutralGear;
}

// Rolls on with the clutch down, where nothing asks for it.
bool SimulatedLearner::coasts(const DriveSample& now) {
  if (!is_due(FaultKind::coasting)) return false;
  // A shift that comes next would only be a slow one.
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear >= 2 && !intent().next_gear;
  if (coasts_until_ == 0.0 && coupled && now.car.road_speed > kCoasts)
    coasts_until_ = pause_until_ = now.time() + kRollsOn * faults_.of(FaultKind::coasting);
  if (coasts_until_ == 0.0 || (now.time() >= coasts_until_ && once(FaultKind::coasting))) return false;
  feet_.throttle.go(0.0, kLiftRate);
  feet_.brake.go(0.0, kBrakeRate);
  // Open, but not what lessons call down: a shift does not begin with it.
  feet_.clutch.go(car_.clutch.bite + kHardlyOpen, kPressRate);
  return true;
}

// Reverse, while the car still rolls forward.
std::optional<int> SimulatedLearner::reverse_too_soon(const DriveSample& now) const {
  const bool rolls = now.car.road_speed > kRolls && now.car.road_speed < kCoasts;
  const bool is_next = known_ + 1 < intents_.size() && intents_[known_ + 1].gear == kReverseGear;
  if (!is_due(FaultKind::wrong_direction) || !rolls || !is_next) return std::nullopt;
  return clutch_is_down_ ? intents_[known_ + 1].gear : std::nullopt;
}

// The lower gear at once, instead of slowing down for it first.
std::optional<int> SimulatedLearner::too_low_a_gear(const DriveSample& now) const {
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear > 1;
  if (!is_due(FaultKind::early_downshift) || intent().motion != Motion::slow || !coupled) return std::nullopt;
  const auto is_lower = [&](const LessonIntent& later) { return later.gear && *later.gear < now.car.gear; };
  const auto next = std::find_if(intents_.begin() + static_cast<std::ptrdiff_t>(known_), intents_.end(), is_lower);
  return next != intents_.end() && *next->gear >= 1 ? next->gear : std::nullopt;
}

bool SimulatedLearner::lugs(const DriveSample& now) {
  if (!is_due(FaultKind::lugging)) return false;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear >= 1;
  if (lug_gear_ == kNeutralGear) {
    if (coupled && now.car.road_speed > 2.0) lug_gear_ = lugging_gear(now);
    lug_since_ = now.time();
    return false;
  }
  feet_.brake.go(0.0, kBrakeRate);
  if (!coupled) {
    launching_ = false;
    release(now);
    return true;
  }
  feet_.throttle.go(1.0, 4.0);
  if (now.car.engine_speed < car_.engine.lug_below && now.car.engine_load > 0.7) lugged_ += period_;
  if (lugged_ > 1.4 || now.time() - lug_since_ > 8.0) {
    once(FaultKind::lugging);
    lug_gear_ = kNeutralGear;
  }
  return true;
}

// Where the lesson ends at a stand there, else at once.
bool SimulatedLearner::brakes_to_stall(const DriveSample& now) const noexcept {
  if (!is_due(FaultKind::stall) || lesson_.start.speed <= 0.0 || now.car.gear == kNeutralGear) return false;
  const auto stands = [](const LessonIntent& wants) { return wants.motion == Motion::stand; };
  return intent().motion == Motion::stand || std::none_of(intents_.begin(), intents_.end(), stands);
}

bool SimulatedLearner::stalls_by_brake(const DriveSample& now) {
  if (!brakes_to_stall(now)) return false;
  feet_.throttle.go(0.0, kLiftRate);
  feet_.clutch.go(0.0, kToBite);
  feet_.brake.go(0.6, kBrakeRate);
  return true;
}

}  // namespace gearshift
