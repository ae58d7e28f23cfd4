#include "app/vehicle/engine_control.h"

#include <algorithm>

namespace gearshift::vehicle {
namespace {
// The engine fires once the starter has turned it this fast and this far. The control of a four-stroke engine needs up
// to two turns (12.57 rad) to find out which cylinder is next. Both are engineering values.
constexpr double kMinCrankSpeed = 0.5;    // [1] fraction of EngineSpec::starter_speed
constexpr double kMinCrankAngle = 12.57;  // [rad]
}  // namespace

EngineControl::EngineControl(const EngineSpec& spec) noexcept : spec_(spec) {
  const double max_torque = combustion_torque(spec.idle);
  idle_load_ = max_torque > 0.0 ? std::min(1.0, friction_torque(spec, spec.idle) / max_torque) : 0.0;
}

void EngineControl::turn_key(bool ignition, bool starter) noexcept {
  ignition_ = ignition;
  starter_ = ignition && starter;
  if (!starter_) cranked_ = 0.0;
}

void EngineControl::set(bool running, bool stalled) noexcept {
  firing_ = {running, false};
  stalled_ = stalled && !running;
  has_run_ = running || stalled;
}

// The engine counts as running by itself only at or above its stall speed. Below that speed the starter still drives
// it.
void EngineControl::update(double speed) noexcept {
  firing_ = next(speed);
  if (!ignition_) {
    has_run_ = stalled_ = false;
  } else if (!firing_.running) {
    stalled_ = has_run_;
  } else if (speed >= spec_.stall) {
    has_run_ = true;
    stalled_ = false;
  }
}

EngineControl::FiringState EngineControl::next(double speed) const noexcept {
  if (!ignition_) return {false, false};
  const bool turned = starter_ && cranked_ >= kMinCrankAngle && speed >= kMinCrankSpeed * spec_.starter_speed;
  const bool survives = firing_.running && speed >= spec_.stall;
  const bool running = turned || survives;
  const bool cut = speed > spec_.limiter || (firing_.cut && speed >= spec_.limiter - spec_.limiter_band);
  return {running, running && cut};
}

// Below the table's first speed, the table's first point applies: otherwise the starter could not bring the engine up
// to speed.
double EngineControl::combustion_torque(double speed) const noexcept {
  const double tabled = spec_.points > 0 ? std::max(speed, spec_.full_load[0].speed) : speed;
  return full_torque(spec_, tabled) + friction_torque(spec_, speed);
}

// Proportional idle control: the load that idling needs, raised below idle speed and lowered above it. If the pedal's
// load is larger, the pedal's load applies.
double EngineControl::load(double speed, double pedal) const noexcept {
  if (!firing_.running || firing_.cut) return 0.0;
  const double idling = std::clamp(idle_load_ + spec_.idle_gain * (spec_.idle - speed), 0.0, 1.0);
  return std::max(pedal, idling);
}

double EngineControl::torque(double speed, double pedal) const noexcept {
  double torque = 0.0;
  const double opened = load(speed, pedal);
  if (opened > 0.0) torque += opened * combustion_torque(speed);
  if (is_cranking_at(speed)) torque += spec_.starter_torque * (1.0 - speed / spec_.starter_speed);
  return torque;
}

}  // namespace gearshift::vehicle
