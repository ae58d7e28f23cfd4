// Deliberate errors of the simulated driver, except errors within a shift.
#include <algorithm>
#include <cmath>

#include "app/lessons/simulated_driver/driver_constants.h"
#include "app/lessons/simulated_driver/simulated_driver.h"

namespace gearshift::lessons {

// True if the driver still has to make a deliberate error during the launch.
bool SimulatedDriver::has_pending_error(const vehicle::DriveSample& now) const noexcept {
  if (now.car.gear == haptics::kNeutralGear) return false;
  const bool hill = std::abs(lesson_.start.slope) > kMinHillSlope;
  return (hill && is_due(ErrorKind::rollback)) || is_due(ErrorKind::stall) || is_due(ErrorKind::clutch_dump) ||
         is_due(ErrorKind::jerk);
}

// Makes the deliberate errors of a launch. Returns true while one is in progress.
bool SimulatedDriver::spoil_launch(const vehicle::DriveSample& now) {
  if (!has_pending_error(now)) return false;
  const bool dumps = is_due(ErrorKind::clutch_dump);
  const double revs = dumps ? kDumpSpeed : kJerkSpeed;
  const bool by_foot = intent().motion == Motion::bite && intent().brake;
  if (by_foot && !is_due(ErrorKind::rollback)) return false;  // only after the brake is off
  if (feet_.hand_brake.value() > 0.05 && !is_due(ErrorKind::rollback) && !is_due(ErrorKind::stall)) {
    // Rev up before releasing the handbrake, because otherwise the car would roll back on a hill.
    feet_.throttle.move_to(kHurryThrottle, 4.0);
    if (now.car.engine_speed >= revs) feet_.hand_brake.move_to(0.0, kHandBrakeRate);
    return true;
  }
  if (is_held()) {
    // Release the brake before the clutch bites.
    if (intent().motion == Motion::bite) feet_.hand_brake.move_to(0.0, kHandBrakeRate);
    feet_.brake.move_to(0.0, kBrakeRate);
    hold_revs(launch_speed_);
    feet_.clutch.move_to(bite_ + kHoverMargin, kClutchRateToBite);
    rolls_since_ = now.time();
    return true;
  }
  if (is_due(ErrorKind::rollback)) {
    hold_revs(launch_speed_);
    const bool rolls = now.time() - rolls_since_ < 0.8 * errors_.of(ErrorKind::rollback);
    if (!rolls) mark_done(ErrorKind::rollback);
    return rolls;
  }
  if (is_due(ErrorKind::stall)) {
    feet_.throttle.move_to(0.0, kLiftRate);
    feet_.clutch.move_to(0.0, 3.0);
    return true;
  }
  feet_.throttle.move_to(kHurryThrottle, 4.0);
  const bool releases_early = feet_.clutch.goal() == 0.0 && feet_.clutch.value() < bite_;
  if (now.car.engine_speed >= revs || releases_early) feet_.clutch.move_to(0.0, dumps ? kDumpRate : kAbruptRate);
  if (feet_.clutch.value() == 0.0) mark_done(dumps ? ErrorKind::clutch_dump : ErrorKind::jerk);
  return true;
}

bool SimulatedDriver::make_over_rev(const vehicle::DriveSample& now) {
  if (!is_due(ErrorKind::over_rev) || !now.car.running) return false;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  const bool late = over_rev_late_ && coupled && now.car.gear >= 1 && now.car.gear <= 2;
  const bool is_stopped = std::abs(now.car.road_speed) < kMaxStandingSpeed;
  const bool with_open_clutch = !over_rev_late_ && clutch_is_down_ && (is_stopped || feet_.brake.goal() < 0.5);
  if (!late && !with_open_clutch) return false;
  feet_.throttle.move_to(1.0, 8.0);
  if (now.car.engine_speed > 1.01 * car_.engine.red_line && mark_done(ErrorKind::over_rev) && with_open_clutch)
    release_at_ = now.time() + kSettleAfterOverRev;
  return true;
}

// Returns the highest gear, from the current gear up, in which the engine would labour at this speed; neutral if none.
int SimulatedDriver::lugging_gear(const vehicle::DriveSample& now) const noexcept {
  for (int gear = haptics::kMaxGear; gear >= std::max(1, now.car.gear); --gear) {
    if (haptics::slot_of_gear(gate_, gear) == haptics::kNoSlot) continue;
    const double speed = shaft_speed_in(now, gear);
    if (speed < 0.95 * car_.engine.lug_below && speed > 1.25 * car_.engine.stall) return gear;
  }
  return haptics::kNeutralGear;
}

// Makes the error `coasting`: the car rolls with the clutch open for no reason. Returns true while the error is in
// progress.
bool SimulatedDriver::make_coasting(const vehicle::DriveSample& now) {
  if (!is_due(ErrorKind::coasting)) return false;
  // Do not coast just before a shift. There, an open clutch would count only as a slow shift.
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear >= 2 && !intent().next_gear;
  if (coasts_until_ == 0.0 && coupled && now.car.road_speed > kMinCoastingSpeed)
    coasts_until_ = pause_until_ = now.time() + kCoastTime * errors_.of(ErrorKind::coasting);
  if (coasts_until_ == 0.0 || (now.time() >= coasts_until_ && mark_done(ErrorKind::coasting))) return false;
  feet_.throttle.move_to(0.0, kLiftRate);
  feet_.brake.move_to(0.0, kBrakeRate);
  // Open the clutch, but press the pedal less far than a step "clutch down" requires, so that no such step is
  // completed.
  feet_.clutch.move_to(bite_ + kOpenMargin, kPressRate);
  return true;
}

// For the deliberate error `wrong_direction`, returns reverse while the car still rolls forward; otherwise empty.
std::optional<int> SimulatedDriver::early_reverse_gear(const vehicle::DriveSample& now) const {
  const bool rolls = now.car.road_speed > kMinRollingSpeed && now.car.road_speed < kMinCoastingSpeed;
  const bool is_next = current_step_ + 1 < intents_.size() && intents_[current_step_ + 1].gear == haptics::kReverseGear;
  if (!is_due(ErrorKind::wrong_direction) || !rolls || !is_next) return std::nullopt;
  return clutch_is_down_ ? intents_[current_step_ + 1].gear : std::nullopt;
}

// For the deliberate error `early_downshift`, returns the lower gear before the car has slowed down; otherwise empty.
std::optional<int> SimulatedDriver::early_downshift_gear(const vehicle::DriveSample& now) const {
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear > 1;
  if (!is_due(ErrorKind::early_downshift) || intent().motion != Motion::slow || !coupled) return std::nullopt;
  const auto is_lower = [&](const LessonIntent& later) { return later.gear && *later.gear < now.car.gear; };
  const auto next =
      std::find_if(intents_.begin() + static_cast<std::ptrdiff_t>(current_step_), intents_.end(), is_lower);
  return next != intents_.end() && *next->gear >= 1 ? next->gear : std::nullopt;
}

bool SimulatedDriver::make_lugging(const vehicle::DriveSample& now) {
  if (!is_due(ErrorKind::lugging)) return false;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked && now.car.gear >= 1;
  if (lug_gear_ == haptics::kNeutralGear) {
    if (coupled && now.car.road_speed > 2.0) lug_gear_ = lugging_gear(now);
    lug_since_ = now.time();
    return false;
  }
  feet_.brake.move_to(0.0, kBrakeRate);
  if (!coupled) {
    launching_ = false;
    release(now);
    return true;
  }
  feet_.throttle.move_to(1.0, 4.0);
  if (now.car.engine_speed < car_.engine.lug_below && now.car.engine_load > 0.7) lug_time_ += period_;
  if (lug_time_ > 1.4 || now.time() - lug_since_ > 8.0) {
    mark_done(ErrorKind::lugging);
    lug_gear_ = haptics::kNeutralGear;
  }
  return true;
}

// True if the driver should now stall the engine on purpose by braking with the clutch up. Only in lessons that start
// with a rolling car: in the stop if the lesson contains one, otherwise at once.
bool SimulatedDriver::should_stall_by_brake(const vehicle::DriveSample& now) const noexcept {
  if (!is_due(ErrorKind::stall) || lesson_.start.speed <= 0.0 || now.car.gear == haptics::kNeutralGear) return false;
  const auto is_stop = [](const LessonIntent& wants) { return wants.motion == Motion::stop; };
  return intent().motion == Motion::stop || std::none_of(intents_.begin(), intents_.end(), is_stop);
}

bool SimulatedDriver::make_brake_stall(const vehicle::DriveSample& now) {
  if (!should_stall_by_brake(now)) return false;
  feet_.throttle.move_to(0.0, kLiftRate);
  feet_.clutch.move_to(0.0, kClutchRateToBite);
  feet_.brake.move_to(0.6, kBrakeRate);
  return true;
}

}  // namespace gearshift::lessons
