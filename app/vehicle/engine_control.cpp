#include "app/vehicle/engine_control.h"

#include <algorithm>

namespace gearshift {
namespace {
// A dead engine fires once the starter has turned it so fast, and so far: a four-stroke's control knows after two turns
// at the latest which cylinder is next. [engineering value]s
constexpr double kFiresAt = 0.5;        // [1] of the starter's speed
constexpr double kFindsItself = 12.57;  // [rad]
}  // namespace

EngineControl::EngineControl(const EngineSpec& spec) noexcept : spec_(spec) {
  const double most = full(spec.idle);
  idle_load_ = most > 0.0 ? std::min(1.0, friction_torque(spec, spec.idle) / most) : 0.0;
}

void EngineControl::turn_key(bool ignition, bool starter) noexcept {
  ignition_ = ignition;
  starter_ = ignition && starter;
  if (!starter_) cranked_ = 0.0;
}

void EngineControl::set(bool running, bool stalled) noexcept {
  fires_ = {running, false};
  stalled_ = stalled && !running;
  has_run_ = running || stalled;
}

// One that fires under the starter has not run by itself: it may die as the key is let go.
void EngineControl::update(double speed) noexcept {
  fires_ = next(speed);
  if (!ignition_) {
    has_run_ = stalled_ = false;
  } else if (!fires_.running) {
    stalled_ = has_run_;
  } else if (speed >= spec_.stall) {
    has_run_ = true;
    stalled_ = false;
  }
}

EngineControl::Fires EngineControl::next(double speed) const noexcept {
  if (!ignition_) return {false, false};
  const bool turned = starter_ && cranked_ >= kFindsItself && speed >= kFiresAt * spec_.starter_speed;
  const bool survives = fires_.running && speed >= spec_.stall;
  const bool running = turned || survives;
  const bool cut = speed > spec_.limiter || (fires_.cut && speed >= spec_.limiter - spec_.limiter_band);
  return {running, running && cut};
}

// Below the table the engine has what it has at its first point: the starter would not bring it up otherwise.
double EngineControl::full(double speed) const noexcept {
  const double tabled = spec_.points > 0 ? std::max(speed, spec_.full_load[0].speed) : speed;
  return full_torque(spec_, tabled) + friction_torque(spec_, speed);
}

// The idle control is proportional about the load that idling needs; the pedal takes over where it asks for more.
double EngineControl::load(double speed, double pedal) const noexcept {
  if (!fires_.running || fires_.cut) return 0.0;
  const double idling = std::clamp(idle_load_ + spec_.idle_gain * (spec_.idle - speed), 0.0, 1.0);
  return std::max(pedal, idling);
}

double EngineControl::torque(double speed, double pedal) const noexcept {
  double torque = 0.0;
  const double opened = load(speed, pedal);
  if (opened > 0.0) torque += opened * full(speed);
  if (cranks(speed)) torque += spec_.starter_torque * (1.0 - speed / spec_.starter_speed);
  return torque;
}

}  // namespace gearshift
