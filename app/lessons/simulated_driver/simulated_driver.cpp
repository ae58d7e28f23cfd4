#include "app/lessons/simulated_driver/simulated_driver.h"

#include <algorithm>
#include <cmath>

#include "app/lessons/simulated_driver/driver_constants.h"

namespace gearshift::lessons {

SimulatedDriver::SimulatedDriver(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                                 const DriverSkill& skill, const DeliberateErrors& errors, std::uint64_t seed,
                                 double period)
    : lesson_(lesson_in_car(lesson, car)),
      car_(car),
      bite_(car.clutch.bite + skill.bite_error),
      gate_(gate),
      skill_(skill),
      errors_(errors),
      random_(seed),
      period_(period),
      feet_{Foot(skill.pedal_noise, seed + 1), Foot(skill.pedal_noise, seed + 2), Foot(skill.pedal_noise, seed + 3),
            Foot(0.0, seed + 4)},
      hand_(period),
      ignition_(lesson.start.running),
      has_run_(lesson.start.running) {
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) intents_.push_back(intent_of(lesson_, i));
  feet_.hand_brake.place(lesson.start.hand_brake);
  feet_.brake.place(lesson.start.brake);
  release_rate_ = kClutchRateThroughBite;
  launch_speed_ = kLaunchSpeed;
  brake_effort_ =
      std::min(1.0, skill_.brake_effort * std::exp(skill_.release_spread * haptics::GaussianNoise(seed + 5).next()));
  for (std::size_t i = 0; i + 1 < intents_.size(); ++i) {
    const int gear = intents_[i].gear.value_or(haptics::kNeutralGear);
    const bool low = gear == 1 || gear == 2;
    over_rev_late_ = over_rev_late_ || (low && intents_[i].accelerates && intents_[i + 1].next_gear);
  }
}

void SimulatedDriver::take_over(const haptics::DriverControls& controls) noexcept {
  feet_.throttle.place(controls.pedals.throttle);
  feet_.brake.place(controls.pedals.brake);
  feet_.clutch.place(controls.pedals.clutch);
  feet_.hand_brake.place(controls.pedals.hand_brake);
  ignition_ = controls.ignition;
}

vehicle::DriverAction SimulatedDriver::act(const vehicle::DriveSample& now, std::size_t step) {
  notice(std::min(step, intents_.size() - 1), now.time());
  has_run_ = has_run_ || now.car.running;
  const bool stalls = was_running_ && !now.car.running && ignition_;
  if (stalls && launch_speed_ < kLaunchSpeed)
    launch_speed_ = std::min(kLaunchSpeed, kLaunchSpeedAfterStall * launch_speed_);
  was_running_ = now.car.running;
  perceived_speed_ += (now.car.engine_speed - perceived_speed_) * std::min(1.0, period_ / skill_.hearing_delay);
  const bool is_down = now.car.pedals.clutch >= bite_;
  if (is_down && !clutch_is_down_) clutch_down_at_ = now.time();
  clutch_is_down_ = is_down;
  if (!handle_restart(now)) {
    std::optional<int> gear = wanted_gear(now);
    if (!gear) gear = early_downshift_gear(now);
    if (!gear) gear = early_reverse_gear(now);
    const bool begins = !shifting_ && gear && now.time() >= pause_until_;
    const bool spins = begins && should_spin_shaft(now);
    if (begins && !spins) begin_shift(now, *gear);
    if (spins) {
      feet_.clutch.move_to(0.0, kClutchRateToBite);
    } else if (shifting_) {
      follow_shift(now);
    } else {
      drive(now);
    }
  }
  rest_hand(now);

  vehicle::DriverAction action;
  action.hand = hand_.next(now.time(), now.lever.lever);
  action.controls.pedals.throttle = feet_.throttle.step(period_);
  action.controls.pedals.brake = is_foot_free(now.time()) ? feet_.brake.step(period_) : 0.0;
  action.controls.pedals.clutch = feet_.clutch.step(period_);
  action.controls.pedals.hand_brake = feet_.hand_brake.step(period_);
  action.controls.ignition = ignition_;
  action.controls.starter = starter_;
  action.controls.slope = lesson_.start.slope;
  return action;
}

// True if the right foot can brake. Moving the foot from throttle to brake takes a moment.
bool SimulatedDriver::is_foot_free(double time) noexcept {
  if (feet_.throttle.value() > 0.0) on_throttle_at_ = time;
  return feet_.brake.value() > 0.0 || time - on_throttle_at_ >= skill_.foot_change;
}

// Makes the driver act on a step only after the time needed to notice the step and to read its prompt.
void SimulatedDriver::notice(std::size_t step, double time) {
  if (noticed_at_ < 0.0) noticed_at_ = progress_at_ = time;
  if (step != noticed_step_) {
    noticed_step_ = step;
    noticed_at_ = progress_at_ = time;
    reaction_ = std::max(0.1, skill_.reaction + noise(skill_.timing_spread)) + reading_time_of(noticed_step_) +
                kLateStepFactor * errors_.of(ErrorKind::slow_step) * lesson_.steps[step].within.value_or(0.0);
  }
  has_given_up_ = time - progress_at_ > kMaxStepTime;
  if (time - noticed_at_ >= reaction_) current_step_ = noticed_step_;
}

// Time [s] to read the step's prompt; 0 if its text is the same as in the previous step.
double SimulatedDriver::reading_time_of(std::size_t step) const noexcept {
  const bool same = step > 0 && lesson_.steps[step].prompt == lesson_.steps[step - 1].prompt;
  return same ? 0.0 : skill_.reading_time;
}

bool SimulatedDriver::is_due(ErrorKind kind) const noexcept {
  return errors_.of(kind) >= 0.5 && !done_errors_[static_cast<std::size_t>(kind)];
}

bool SimulatedDriver::mark_done(ErrorKind kind) noexcept {
  if (!is_due(kind)) return false;
  done_errors_[static_cast<std::size_t>(kind)] = true;
  return true;
}

// Speed of the clutch shaft in `gear` at the current road speed [rad/s].
double SimulatedDriver::shaft_speed_in(const vehicle::DriveSample& now, int gear) const noexcept {
  return vehicle::shaft_per_road(car_, gear) * now.car.road_speed;
}

// Turns the key if the lesson requires it or the engine has stalled. Returns true while the engine is being started.
bool SimulatedDriver::handle_restart(const vehicle::DriveSample& now) {
  if (intent().ignition) ignition_ = *intent().ignition;
  const bool wanted = intent().start || (has_run_ && intent().ignition != false);
  if (now.car.running || !wanted) {
    if (starter_ && (!wanted || now.car.engine_speed > 0.8 * car_.engine.idle)) starter_ = false;
    return starter_;
  }
  if (has_run_) mark_done(ErrorKind::stall);
  const bool bumps = !has_run_ && now.car.gear >= 1 && now.car.road_speed > kMinBumpSpeed;
  if (bumps) {
    feet_.clutch.move_to(0.0, kClutchRateToBite);
    return true;
  }
  shifting_ = false;
  lug_gear_ = haptics::kNeutralGear;
  feet_.throttle.move_to(0.0, kLiftRate);
  press_clutch();
  if (std::abs(now.car.road_speed) > kMaxStandingSpeed && feet_.brake.goal() < kStopBrake)
    feet_.brake.move_to(kStopBrake, kBrakeRate);
  ignition_ = true;
  starter_ = clutch_is_down_;
  return true;
}

}  // namespace gearshift::lessons
