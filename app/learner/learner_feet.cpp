// Between the shifts: away, along, slower, to a stand.
#include <algorithm>
#include <cmath>

#include "app/learner/learner_habits.h"
#include "app/learner/simulated_learner.h"

namespace gearshift {

void SimulatedLearner::set_brakes(const DriveSample& now) {
  const LessonIntent& wants = intent();
  if (wants.brake) feet_.brake.go(wants.at_once ? brake_effort_ : *wants.brake, 2.0 * kBrakeRate);
  const bool has_no_patience = wants.motion == Motion::bite && means_ill(now);
  if (!wants.hand_brake || has_no_patience) return;
  const bool hill = std::abs(lesson_.start.slope) > kHill && !means_ill(now);
  const bool may = *wants.hand_brake > 0.0 || wants.motion == Motion::stay || !hill || feels_bite(now);
  if (may) feet_.hand_brake.go(*wants.hand_brake, kHandBrakeRate);
}

void SimulatedLearner::drive(const DriveSample& now) {
  set_brakes(now);
  if (now.time() < pause_until_ && now.car.gear == kNeutralGear) {
    feet_.clutch.go(0.0, kToBite);
    return;
  }
  if (over_revs(now) || coasts(now) || lugs(now) || stalls_by_brake(now)) return;
  switch (intent().motion) {
    case Motion::stay:
      lingers_ = shifts_late(now);
      if (lingers_) return *intent().next_gear > now.car.gear ? go_on(now) : slow_down(now);
      feet_.throttle.go(0.0, kLiftRate);
      if (intent().clutch_down && !(is_due(FaultKind::no_clutch) && intent().next_gear)) press_clutch();
      break;
    case Motion::go:
      go_on(now);
      break;
    case Motion::bite:
      release(now);
      break;
    case Motion::creep:
      creep(now);
      break;
    case Motion::slow:
      slow_down(now);
      break;
    case Motion::stand:
      stand(now);
      break;
  }
}

void SimulatedLearner::go_on(const DriveSample& now) {
  feet_.brake.go(0.0, kBrakeRate);
  const double rides = faults_.of(FaultKind::riding_clutch);
  const double rest = rides > 0.0 && now.car.road_speed > kRolls ? kFootWeighs + kFootWeighsMore * rides : 0.0;
  const bool is_up = feet_.clutch.value() <= rest && now.car.clutch_locked;
  const bool dies = now.car.clutch_locked && heard_ < kSaves * car_.engine.idle && now.car.running;
  if (dies || (saves_ && now.car.engine_speed < car_.engine.idle)) {
    saves_ = true;
    feet_.throttle.go(0.2, kThrottleRate);
    return press_clutch();
  }
  saves_ = false;
  if (!is_up || now.car.gear == kNeutralGear) return release(now);
  feet_.clutch.go(rest, kToBite);
  double throttle = intent().accelerates ? kAccelerate : kCruise;
  if (intent().no_throttle) throttle = 0.0;
  feet_.throttle.go(shifts_late(now) ? kHurry : throttle, kThrottleRate);
}

void SimulatedLearner::slow_down(const DriveSample& now) {
  feet_.throttle.go(0.0, kLiftRate);
  if (!intent().brake) feet_.brake.go(kSlowBrake, kBrakeRate);
  if (now.car.engine_speed < 1.1 * car_.engine.idle && now.car.clutch_locked) press_clutch();
}

void SimulatedLearner::stand(const DriveSample& now) {
  feet_.throttle.go(0.0, kLiftRate);
  feet_.brake.go(std::max(feet_.brake.goal(), kStandBrake), kBrakeRate);
  const bool slow = heard_ < 1.5 * car_.engine.idle && now.car.clutch_locked;
  if (!slow) slow_since_ = now.time();
  const bool due = slow && now.time() - slow_since_ >= skill_.reaction;
  if (due || !now.car.clutch_locked || now.car.gear == kNeutralGear) press_clutch();
}

// Keeps the engine at a speed, by ear: proportional, as far as the foot is quick enough.
void SimulatedLearner::hold_revs(double speed) {
  const double throttle = kHoldBase + kHoldGain * (speed - heard_);
  feet_.throttle.go(std::clamp(throttle, 0.0, 0.8), 4.0);
}

bool SimulatedLearner::feels_bite(const DriveSample& now) const noexcept {
  if (feet_.clutch.value() >= car_.clutch.bite || now.car.gear == kNeutralGear) return false;
  if (intent().no_throttle) return heard_ < car_.engine.idle - kIdleDrop;
  return heard_ < launch_target() - kBiteDrop && feet_.throttle.value() > 0.25;
}

double SimulatedLearner::launch_target() const noexcept {
  return launch_speed_ * (1.0 + kHowl * faults_.of(FaultKind::clutch_burn));
}

void SimulatedLearner::release(const DriveSample& now) {
  if (now.time() < release_at_) {
    feet_.clutch.hold();
    const bool too_soon = faults_.of(FaultKind::step_order) > 0.0 && shift_.between_gears;
    feet_.throttle.go(too_soon ? kThrottleTooSoon : 0.0, kThrottleRate);
    return;
  }
  const double turns = std::abs(asked(now, now.car.gear));
  if (clutch_is_down_) launching_ = turns < 1.05 * car_.engine.idle && lug_gear_ == kNeutralGear;
  if (!launching_) return release_rolling(now, turns);
  if (!now.car.clutch_locked) return launch(now);
  feet_.throttle.hold();
  feet_.clutch.go(0.0, kAfterLaunch);
}

// turns: what the gear asks of the engine. [rad/s]
void SimulatedLearner::release_rolling(const DriveSample& now, double turns) {
  const bool slips = !now.car.clutch_locked;
  const bool jerks = faults_.of(FaultKind::jerk) >= 0.5, dumps = is_due(FaultKind::clutch_dump);
  const bool blips = intent().blip && faults_.of(FaultKind::rev_mismatch) <= 0.0 && !jerks;
  if (slips && dumps && !revs_fit(now, turns + kDumpSlip)) return;
  if (slips && blips && !dumps && !revs_fit(now, turns)) return;
  if (!blips && !dumps) {
    feet_.throttle.go(faults_.of(FaultKind::step_order) > 0.0 ? kThrottleTooSoon : 0.0, kThrottleRate);
  }
  const double bite = car_.clutch.bite, pedal = feet_.clutch.value();
  const bool carries_nothing = pedal > bite + 0.01, holds = !slips && pedal < 0.5 * bite;
  if (pedal == 0.0) once(FaultKind::clutch_dump);
  if (carries_nothing) abrupt_ = std::abs(now.car.engine_speed - turns) < kSoundsNear ? kFootOff : kAbrupt;
  if (dumps) return feet_.clutch.go(0.0, kFootOff);
  feet_.clutch.go(0.0, carries_nothing || holds ? kToBite : jerks ? abrupt_ : release_rate_);
}

// Brings the engine there and keeps it there; true once it is, or after a while in which it would not come.
bool SimulatedLearner::revs_fit(const DriveSample& now, double speed) {
  if (blip_since_ < 0.0) blip_since_ = now.time();
  const double meant = speed * ear_;
  hold_revs(meant);
  const bool fits = std::abs(heard_ - meant) < kFits + skill_.rev_spread * speed;
  if (!fits && !revs_fit_) fit_since_ = now.time();
  revs_fit_ = revs_fit_ || now.time() - fit_since_ > kFitsFor;
  return revs_fit_ || now.time() - blip_since_ > kBlipMost;
}

// From a stand: throttle first, the pedal quickly to where it begins to carry, then slowly until the clutch holds.
void SimulatedLearner::launch(const DriveSample& now) {
  if (spoils_launch(now)) return;
  const double target = launch_target();
  if (intent().no_throttle) {
    feet_.throttle.go(0.0, kLiftRate);
  } else {
    hold_revs(target);
  }
  const bool held = feet_.hand_brake.value() > 0.05;
  const bool labours = !intent().no_throttle && heard_ < (1.0 - skill_.bite_fall) * target && !held;
  if ((held && feels_bite(now)) || (labours && now.car.gear != kNeutralGear)) return feet_.clutch.hold();
  if (held && intent().motion == Motion::go && !intent().hand_brake) feet_.hand_brake.go(0.0, kHandBrakeRate);
  const bool idle_stroke = feet_.clutch.value() > car_.clutch.bite + 0.01;
  feet_.clutch.go(0.0, idle_stroke ? kToBite : kLaunchRate * release_rate_ / kThroughBite);
}

void SimulatedLearner::creep(const DriveSample& now) {
  feet_.brake.go(0.0, kBrakeRate);
  if (now.time() < release_at_ || spoils_launch(now)) return;
  if (intent().no_throttle) {
    feet_.throttle.go(0.0, kLiftRate);
  } else {
    hold_revs(1.3 * car_.engine.idle);
  }
  const double speed = std::abs(now.car.road_speed), bite = car_.clutch.bite;
  if (feet_.clutch.value() > bite + 0.01) {
    feet_.clutch.go(0.0, kToBite);
  } else if (speed > 1.15 * intent().speed) {
    feet_.clutch.go(bite - kHardlyBites, 0.4);
  } else if (speed < 0.9 * intent().speed && heard_ > 0.85 * car_.engine.idle) {
    feet_.clutch.go(0.0, kCreepRate);
  } else {
    feet_.clutch.hold();
  }
}

}  // namespace gearshift
