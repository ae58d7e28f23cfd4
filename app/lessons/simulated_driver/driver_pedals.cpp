// The pedals between shifts: moving off, driving, slowing down, stopping.
#include <algorithm>
#include <cmath>

#include "app/lessons/simulated_driver/driver_constants.h"
#include "app/lessons/simulated_driver/simulated_driver.h"

namespace gearshift::lessons {

void SimulatedDriver::set_brakes(const vehicle::DriveSample& now) {
  const LessonIntent& wants = intent();
  const bool lets_roll = wants.motion == Motion::bite && is_due(ErrorKind::rollback);
  if (wants.brake && !lets_roll) feet_.brake.move_to(wants.at_once ? brake_effort_ : *wants.brake, 2.0 * kBrakeRate);
  const bool has_no_patience = wants.motion == Motion::bite && has_pending_error(now);
  if (!wants.hand_brake || has_no_patience) return;
  const bool hill = std::abs(lesson_.start.slope) > kMinHillSlope && !has_pending_error(now);
  const bool may = *wants.hand_brake > 0.0 || wants.motion == Motion::stay || !hill || feels_bite(now) ||
                   feet_.brake.value() > kStopBrake || is_pulled_downhill(now.car.gear);
  if (may) feet_.hand_brake.move_to(*wants.hand_brake, kHandBrakeRate);
}

void SimulatedDriver::drive(const vehicle::DriveSample& now) {
  set_brakes(now);
  if (now.time() < pause_until_ && now.car.gear == haptics::kNeutralGear) {
    feet_.clutch.move_to(0.0, kClutchRateToBite);
    return;
  }
  if (make_over_rev(now) || make_coasting(now) || make_lugging(now) || make_brake_stall(now)) return;
  switch (intent().motion) {
    case Motion::stay:
      is_lingering_ = should_shift_late(now);
      if (is_lingering_) return *intent().next_gear > now.car.gear ? drive_on(now) : slow_down(now);
      feet_.throttle.move_to(0.0, kLiftRate);
      if (intent().clutch_down && !(is_due(ErrorKind::no_clutch) && intent().next_gear)) press_clutch();
      break;
    case Motion::go:
      drive_on(now);
      break;
    case Motion::bite:
      if (now.car.running) {
        release(now);
      } else {
        feet_.clutch.move_to(0.0, kClutchRateToBite);
      }
      break;
    case Motion::hold:
      hold_on_the_clutch(now);
      break;
    case Motion::creep:
      creep(now);
      break;
    case Motion::slow:
      slow_down(now);
      break;
    case Motion::stop:
      stop(now);
      break;
  }
}

void SimulatedDriver::drive_on(const vehicle::DriveSample& now) {
  if (!intent().brake) feet_.brake.move_to(0.0, kBrakeRate);
  const double rides = errors_.of(ErrorKind::riding_clutch);
  const double rest =
      rides > 0.0 && now.car.road_speed > kMinRollingSpeed ? kRestingPedal + kRestingPedalGain * rides : 0.0;
  const bool is_up = feet_.clutch.value() <= rest && now.car.clutch_locked;
  const bool dies = now.car.clutch_locked && perceived_speed_ < kStallRescueSpeed * car_.engine.idle && now.car.running;
  if (dies || (is_rescuing_ && now.car.engine_speed < car_.engine.idle)) {
    is_rescuing_ = true;
    feet_.throttle.move_to(0.2, kThrottleRate);
    return press_clutch();
  }
  is_rescuing_ = false;
  if (!is_up || now.car.gear == haptics::kNeutralGear) return release(now);
  feet_.clutch.move_to(rest, kClutchRateToBite);
  double throttle = skill_.throttle_factor * (intent().accelerates ? kAccelerateThrottle : kCruiseThrottle);
  if (intent().no_throttle) throttle = 0.0;
  feet_.throttle.move_to(should_shift_late(now) ? kHurryThrottle : throttle, kThrottleRate);
}

void SimulatedDriver::slow_down(const vehicle::DriveSample& now) {
  feet_.throttle.move_to(0.0, kLiftRate);
  if (!intent().brake) feet_.brake.move_to(kSlowBrake, kBrakeRate);
  if (now.car.engine_speed < 1.1 * car_.engine.idle && now.car.clutch_locked) press_clutch();
}

void SimulatedDriver::stop(const vehicle::DriveSample& now) {
  feet_.throttle.move_to(0.0, kLiftRate);
  feet_.brake.move_to(std::max(feet_.brake.goal(), kStopBrake), kBrakeRate);
  const bool slow = perceived_speed_ < 1.5 * car_.engine.idle && now.car.clutch_locked;
  if (!slow) slow_since_ = now.time();
  const bool due = slow && now.time() - slow_since_ >= skill_.reaction;
  if (due || !now.car.clutch_locked || now.car.gear == haptics::kNeutralGear) press_clutch();
}

// Holds the engine speed by ear: proportional control, limited by how fast the foot moves.
void SimulatedDriver::hold_revs(double speed) {
  const double friction = vehicle::friction_torque(car_.engine, speed);
  const double free = friction / (vehicle::full_torque(car_.engine, speed) + friction);  // keeps a free engine turning
  const double throttle = free + kRevHoldGain * (speed - perceived_speed_);
  feet_.throttle.move_to(std::clamp(throttle, 0.0, 0.8), 4.0);
}

bool SimulatedDriver::feels_bite(const vehicle::DriveSample& now) const noexcept {
  if (feet_.clutch.value() >= bite_ || now.car.gear == haptics::kNeutralGear) return false;
  if (intent().no_throttle) return perceived_speed_ < car_.engine.idle - kIdleDrop;
  return perceived_speed_ < launch_target() - kBiteDrop && feet_.throttle.value() > 0.25;
}

double SimulatedDriver::launch_target() const noexcept {
  return launch_speed_ * (1.0 + kBurnSpeedGain * errors_.of(ErrorKind::clutch_burn));
}

void SimulatedDriver::release(const vehicle::DriveSample& now) {
  if (now.time() < release_at_) {
    feet_.clutch.hold();
    const bool too_soon = errors_.of(ErrorKind::step_order) > 0.0 && shift_.between_gears;
    feet_.throttle.move_to(too_soon ? kEarlyThrottle : 0.0, kThrottleRate);
    return;
  }
  const double gear_speed = std::abs(shaft_speed_in(now, now.car.gear));
  if (clutch_is_down_) launching_ = gear_speed < 1.05 * car_.engine.idle && lug_gear_ == haptics::kNeutralGear;
  if (!launching_) return release_rolling(now, gear_speed);
  if (!now.car.clutch_locked) return launch(now);
  feet_.throttle.hold();
  feet_.clutch.move_to(0.0, kClutchRateAfterLaunch);
}

// Releases the clutch while the car rolls. `gear_speed`: engine speed [rad/s] in this gear at the present road speed.
void SimulatedDriver::release_rolling(const vehicle::DriveSample& now, double gear_speed) {
  const bool slips = !now.car.clutch_locked;
  const bool jerks = errors_.of(ErrorKind::jerk) >= 0.5, dumps = is_due(ErrorKind::clutch_dump);
  const bool blips = (intent().blip || ((skill_.blips || skill_.double_clutches) && shift_.is_down)) &&
                     errors_.of(ErrorKind::rev_mismatch) <= 0.0 && !jerks;
  if (slips && dumps && !match_revs(now, gear_speed + kDumpSlip)) return;
  if (slips && blips && !dumps && !match_revs(now, gear_speed)) return;
  if (!blips && !dumps) {
    feet_.throttle.move_to(errors_.of(ErrorKind::step_order) > 0.0 ? kEarlyThrottle : 0.0, kThrottleRate);
  }
  const double pedal = feet_.clutch.value();
  const bool carries_nothing = pedal > bite_ + 0.01, holds = !slips && pedal < 0.5 * bite_;
  if (pedal == 0.0) mark_done(ErrorKind::clutch_dump);
  if (carries_nothing) abrupt_rate_ = std::abs(now.car.engine_speed - gear_speed) < kNearRevs ? kDumpRate : kAbruptRate;
  if (dumps) return feet_.clutch.move_to(0.0, kDumpRate);
  feet_.clutch.move_to(0.0, carries_nothing || holds ? kClutchRateToBite : jerks ? abrupt_rate_ : release_rate_);
}

// Brings the engine to `speed` and holds the engine there. Returns true once the speed is reached, or after a time
// limit.
bool SimulatedDriver::match_revs(const vehicle::DriveSample& now, double speed) {
  if (blip_since_ < 0.0) blip_since_ = now.time();
  const double meant = speed * rev_bias_;
  hold_revs(meant);
  const bool fits = std::abs(perceived_speed_ - meant) < kRevTolerance + skill_.rev_spread * speed;
  if (!fits && !are_revs_matched_) matched_since_ = now.time();
  are_revs_matched_ = are_revs_matched_ || now.time() - matched_since_ > kRevSettleTime;
  return are_revs_matched_ || now.time() - blip_since_ > kMaxBlipTime;
}

// Moves off: first the throttle, then the clutch quickly up to the bite point and slowly until it locks.
void SimulatedDriver::launch(const vehicle::DriveSample& now) {
  if (spoil_launch(now)) return;
  const double target = launch_target();
  if (intent().no_throttle) {
    feet_.throttle.move_to(0.0, kLiftRate);
  } else {
    hold_revs(target);
  }
  const bool held = is_held();
  const bool labours = !intent().no_throttle && perceived_speed_ < (1.0 - skill_.max_bite_drop) * target && !held;
  if ((held && feels_bite(now)) || (labours && now.car.gear != haptics::kNeutralGear)) return feet_.clutch.hold();
  if (held && intent().motion == Motion::go && !intent().hand_brake) feet_.hand_brake.move_to(0.0, kHandBrakeRate);
  const bool idle_stroke = feet_.clutch.value() > bite_ + 0.01;
  feet_.clutch.move_to(0.0,
                       idle_stroke ? kClutchRateToBite : kClutchRateLaunch * release_rate_ / kClutchRateThroughBite);
}

// Feels the car creep, and lets it neither drive nor roll back.
void SimulatedDriver::hold_on_the_clutch(const vehicle::DriveSample& now) {
  if (feet_.hand_brake.value() > 0.05) return launch(now);  // to the bite point
  feet_.brake.move_to(0.0, kBrakeRate);
  if (spoil_launch(now)) return;
  hold_revs(launch_target());
  const double speed = now.car.road_speed;
  if (std::abs(speed) < kMinFeltSpeed) return feet_.clutch.hold();
  feet_.clutch.move_to(speed > 0.0 ? bite_ : 0.0, speed > 0.0 ? kClutchRateCreep : 2.0 * kClutchRateCreep);
}

// True if a brake holds the car while the clutch comes up.
bool SimulatedDriver::is_held() const noexcept {
  return feet_.hand_brake.value() > 0.05 || (intent().motion == Motion::bite && feet_.brake.value() > 0.05);
}

// True if the slope pulls the car in the direction of this gear.
bool SimulatedDriver::is_pulled_downhill(int gear) const noexcept {
  const double towards = gear == haptics::kReverseGear ? lesson_.start.slope : -lesson_.start.slope;
  return gear != haptics::kNeutralGear && towards > kMinHillSlope;
}

void SimulatedDriver::creep(const vehicle::DriveSample& now) {
  const bool runs_away = is_pulled_downhill(now.car.gear) && std::abs(now.car.road_speed) > 1.2 * intent().speed;
  feet_.brake.move_to(runs_away ? kCreepBrake : 0.0, kBrakeRate);
  if (now.time() < release_at_ || spoil_launch(now)) return;
  if (intent().no_throttle) {
    feet_.throttle.move_to(0.0, kLiftRate);
  } else {
    hold_revs(1.3 * car_.engine.idle);
  }
  const double speed = std::abs(now.car.road_speed);
  if (feet_.clutch.value() > bite_ + 0.01) {
    feet_.clutch.move_to(0.0, kClutchRateToBite);
  } else if (speed > 1.15 * intent().speed) {
    feet_.clutch.move_to(bite_ - kLightBite, 0.4);
  } else if (speed < 0.9 * intent().speed && perceived_speed_ > 0.85 * car_.engine.idle) {
    feet_.clutch.move_to(0.0, kClutchRateCreep);
  } else {
    feet_.clutch.hold();
  }
}

}  // namespace gearshift::lessons
