#include "app/learner/simulated_learner.h"

#include <algorithm>
#include <cmath>

#include "app/learner/learner_habits.h"

namespace gearshift {

SimulatedLearner::SimulatedLearner(const Lesson& lesson, const CarSpec& car, const Gate& gate,
                                   const LearnerSkill& skill, const LearnerFaults& faults, std::uint64_t seed,
                                   double period)
    : lesson_(lesson_in_car(lesson, car)),
      car_(car),
      gate_(gate),
      skill_(skill),
      faults_(faults),
      chance_(seed),
      period_(period),
      feet_{Foot(skill.pedal_noise, seed + 1), Foot(skill.pedal_noise, seed + 2), Foot(skill.pedal_noise, seed + 3),
            Foot(0.0, seed + 4)},
      hand_(period),
      ignition_(lesson.start.running),
      has_run_(lesson.start.running) {
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) intents_.push_back(intent_of(lesson, i));
  feet_.hand_brake.place(lesson.start.hand_brake);
  release_rate_ = kThroughBite;
  launch_speed_ = kLaunchSpeed;
  brake_effort_ = std::min(1.0, skill_.brake_effort * std::exp(skill_.release_spread * GaussianNoise(seed + 5).next()));
  for (std::size_t i = 0; i + 1 < intents_.size(); ++i) {
    const int gear = intents_[i].gear.value_or(kNeutralGear);
    const bool low = gear == 1 || gear == 2;
    over_rev_late_ = over_rev_late_ || (low && intents_[i].accelerates && intents_[i + 1].next_gear);
  }
}

void SimulatedLearner::take_over(const DriverControls& controls) noexcept {
  feet_.throttle.place(controls.throttle);
  feet_.brake.place(controls.brake);
  feet_.clutch.place(controls.clutch);
  feet_.hand_brake.place(controls.hand_brake);
  ignition_ = controls.ignition;
}

DriverAction SimulatedLearner::act(const DriveSample& now, std::size_t step) {
  notice(std::min(step, intents_.size() - 1), now.time());
  has_run_ = has_run_ || now.car.running;
  const bool stalls = ran_ && !now.car.running && ignition_;
  if (stalls && launch_speed_ < kLaunchSpeed) launch_speed_ = std::min(kLaunchSpeed, kGasAfterStall * launch_speed_);
  ran_ = now.car.running;
  heard_ += (now.car.engine_speed - heard_) * std::min(1.0, period_ / skill_.hearing);
  const bool is_down = now.car.clutch >= car_.clutch.bite;
  if (is_down && !clutch_is_down_) clutch_down_at_ = now.time();
  clutch_is_down_ = is_down;
  if (!restarts(now)) {
    std::optional<int> gear = wanted_gear(now);
    if (!gear) gear = too_low_a_gear(now);
    if (!gear) gear = reverse_too_soon(now);
    const bool begins = !shifting_ && gear && now.time() >= pause_until_;
    const bool spins = begins && spins_shaft(now);
    if (begins && !spins) begin_shift(now, *gear);
    if (spins) {
      feet_.clutch.go(0.0, kToBite);
    } else if (shifting_) {
      follow_shift(now);
    } else {
      drive(now);
    }
  }
  rest_hand(now);

  DriverAction action;
  action.hand = hand_.next(now.time(), now.lever.lever);
  action.controls.throttle = feet_.throttle.step(period_);
  action.controls.brake = foot_is_free(now.time()) ? feet_.brake.step(period_) : 0.0;
  action.controls.clutch = feet_.clutch.step(period_);
  action.controls.hand_brake = feet_.hand_brake.step(period_);
  action.controls.ignition = ignition_;
  action.controls.starter = starter_;
  action.controls.slope = lesson_.start.slope;
  return action;
}

// One foot has both pedals: on the throttle, it is at the brake only a moment later.
bool SimulatedLearner::foot_is_free(double time) noexcept {
  if (feet_.throttle.value() > 0.0) on_throttle_at_ = time;
  return feet_.brake.value() > 0.0 || time - on_throttle_at_ >= skill_.foot_change;
}

// A step is acted upon once it is seen, and that takes a person's time.
void SimulatedLearner::notice(std::size_t step, double time) {
  if (seen_at_ < 0.0) seen_at_ = progress_at_ = time;
  if (step != seen_) {
    seen_ = step;
    seen_at_ = progress_at_ = time;
    reaction_ = std::max(0.1, skill_.reaction + noise(skill_.timing_spread)) + reading_of(seen_) +
                kLate * faults_.of(FaultKind::slow_step) * lesson_.steps[step].within.value_or(0.0);
  }
  gives_up_ = time - progress_at_ > kGivesUp;
  if (time - seen_at_ >= reaction_) known_ = seen_;
}

// What says the same as the step before was read then.
double SimulatedLearner::reading_of(std::size_t step) const noexcept {
  const bool same = step > 0 && lesson_.steps[step].prompt == lesson_.steps[step - 1].prompt;
  return same ? 0.0 : skill_.reading;
}

bool SimulatedLearner::is_due(FaultKind kind) const noexcept {
  return faults_.of(kind) >= 0.5 && !done_[static_cast<std::size_t>(kind)];
}

bool SimulatedLearner::once(FaultKind kind) noexcept {
  if (!is_due(kind)) return false;
  done_[static_cast<std::size_t>(kind)] = true;
  return true;
}

// [rad/s] of the clutch shaft in that gear, at this speed.
double SimulatedLearner::asked(const DriveSample& now, int gear) const noexcept {
  return shaft_per_road(car_, gear) * now.car.road_speed;
}

// The key, where the lesson asks for it and after a stall.
bool SimulatedLearner::restarts(const DriveSample& now) {
  if (intent().ignition == false) ignition_ = false;
  const bool wanted = intent().start || (has_run_ && intent().ignition != false);
  if (now.car.running || !wanted) {
    if (starter_ && (!wanted || now.car.engine_speed > 0.8 * car_.engine.idle)) starter_ = false;
    return starter_;
  }
  if (has_run_) once(FaultKind::stall);
  shifting_ = false;
  lug_gear_ = kNeutralGear;
  feet_.throttle.go(0.0, kLiftRate);
  press_clutch();
  if (std::abs(now.car.road_speed) > kStill && feet_.brake.goal() < kStandBrake)
    feet_.brake.go(kStandBrake, kBrakeRate);
  ignition_ = true;
  starter_ = clutch_is_down_;
  return true;
}

}  // namespace gearshift
