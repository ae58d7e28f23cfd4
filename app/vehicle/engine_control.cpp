#include "app/vehicle/engine_control.h"

#include <algorithm>

namespace gearshift::vehicle {
namespace {
// The engine fires once it has been turned this far and, by the starter, this fast. The control of a four-stroke engine needs up
// to two turns (12.57 rad) to find out which cylinder is next. Both are engineering values.
constexpr double kMinCrankSpeed = 0.5;    // [1] fraction of EngineSpec::starter_speed
constexpr double kMinCrankAngle = 12.57;  // [rad]
constexpr double kLiftTime = 0.2;         // [s] time constant of the set speed; engineering value
// The integral part stays at a bound until the speed error has changed sign by more than kMinIdleError. Without this
// margin, rounding at idle would end a mode in every step.
constexpr double kMinIdleError = 1e-6;  // [rad/s]
constexpr double kBoundSlack = 1e-9;    // [1]
}  // namespace

EngineControl::EngineControl(const EngineSpec& spec) noexcept
    : spec_(spec), idle_friction_(friction_torque(spec, spec.idle)) {
  const double max_torque = combustion_torque(spec.idle);
  idle_load_ = max_torque > 0.0 ? std::min(1.0, idle_friction_ / max_torque) : 0.0;
}

void EngineControl::turn_key(bool ignition, bool starter) noexcept {
  ignition_ = ignition;
  starter_ = ignition && starter;
}

void EngineControl::set(bool running, bool stalled) noexcept {
  firing_ = {running, false, Integral::free};
  state_ = {};
  stalled_ = stalled && !running;
  has_run_ = running || stalled;
}

// The engine counts as running by itself only at or above its stall speed. Below that speed the starter still drives
// it.
void EngineControl::update(double speed) noexcept {
  const bool was_running = firing_.running;
  firing_ = next(speed, state_);
  if (!firing_.running) state_.integral = state_.lift = 0.0;
  if (was_running != firing_.running || !ignition_ || !(speed > 0.0)) state_.cranked = 0.0;
  state_.integral = std::clamp(state_.integral, 0.0, 1.0);
  if (!ignition_) {
    has_run_ = stalled_ = false;
  } else if (!firing_.running) {
    stalled_ = has_run_;
  } else if (speed >= spec_.stall) {
    has_run_ = true;
    stalled_ = false;
  }
}

EngineControl::FiringState EngineControl::next(double speed, const EngineState& at) const noexcept {
  if (!ignition_) return {false, false, Integral::free};
  const double fires_at = starter_ ? std::min(kMinCrankSpeed * spec_.starter_speed, spec_.stall) : spec_.stall;
  const bool running = speed >= fires_at && (firing_.running || at.cranked >= kMinCrankAngle);
  const bool cut = speed > spec_.limiter || (firing_.cut && speed >= spec_.limiter - spec_.limiter_band);
  return {running, running && cut, running ? next_integral(speed, at) : Integral::free};
}

EngineControl::Integral EngineControl::next_integral(double speed, const EngineState& at) const noexcept {
  const double error = spec_.idle + at.lift - speed;
  if (firing_.integral == Integral::held_low && error < kMinIdleError) return Integral::held_low;
  if (firing_.integral == Integral::held_high && error > -kMinIdleError) return Integral::held_high;
  if (firing_.integral != Integral::free) return Integral::free;
  if (at.integral < -kBoundSlack) return Integral::held_low;
  return at.integral > 1.0 + kBoundSlack ? Integral::held_high : Integral::free;
}

EngineState EngineControl::state_rate(double speed, double slip_torque, const EngineState& at) const noexcept {
  if (!firing_.running) return {0.0, 0.0, ignition_ ? std::max(0.0, speed) : 0.0};
  const double takes_hold = idle_friction_ > 0.0 ? std::min(1.0, slip_torque / idle_friction_) : 0.0;
  EngineState rate;
  if (firing_.integral == Integral::free) rate.integral = spec_.idle_integral_gain * (spec_.idle + at.lift - speed);
  rate.lift = (takes_hold * spec_.idle_lift - at.lift) / kLiftTime;
  return rate;
}

// Below the table's first speed, the table's first point applies: otherwise the starter could not bring the engine up
// to speed.
double EngineControl::combustion_torque(double speed) const noexcept {
  const double tabled = spec_.points > 0 ? std::max(speed, spec_.full_load[0].speed) : speed;
  return full_torque(spec_, tabled) + friction_torque(spec_, speed);
}

// The load that idling needs, raised below the set speed, lowered above it, plus the integral part. The pedal opens what
// is left of the throttle.
double EngineControl::load(double speed, double pedal, const EngineState& at) const noexcept {
  if (!firing_.running || firing_.cut) return 0.0;
  const double error = spec_.idle + at.lift - speed;
  const double idling = std::clamp(idle_load_ + spec_.idle_gain * error + at.integral, 0.0, 1.0);
  return pedal + (1.0 - pedal) * idling;
}

double EngineControl::torque(double speed, double pedal, const EngineState& at) const noexcept {
  double torque = 0.0;
  const double opened = load(speed, pedal, at);
  if (opened > 0.0) torque += opened * combustion_torque(speed);
  if (is_cranking_at(speed)) torque += spec_.starter_torque * (1.0 - std::max(0.0, speed) / spec_.starter_speed);
  return torque;
}

}  // namespace gearshift::vehicle
