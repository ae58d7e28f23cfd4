#include "app/vehicle/engine_shudder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearshift::vehicle {
namespace {
constexpr double kFiringsPerTurn = 2.0;  // four cylinders, each of which fires every second turn
constexpr double kMaxPeriod = 0.5;       // [s] same as kMaxStep in driveline.cpp
}  // namespace

double engine_shudder(const EngineSpec& engine, const VehicleState& now) noexcept {
  if (!now.ignition || now.cranking) return 0.0;
  const double speed = now.engine_speed;
  const double begins = engine.idle - kSmoothDip * (engine.idle - engine.stall);
  const double depth = std::clamp((begins - speed) / (begins - engine.stall), 0.0, 1.0);
  if (!now.running) return speed < engine.stall ? speed / engine.stall : depth;
  const double idle_friction = friction_torque(engine, engine.idle);
  const double load = idle_friction > 0.0 ? std::clamp(now.clutch_torque / idle_friction, 0.0, 1.0) : 1.0;
  return depth * load;
}

double LeverVibration::step(double shudder, double engine_speed, double period) noexcept {
  if (!(shudder > 0.0)) return phase_ = 0.0;
  const double force = amplitude_ * shudder * std::sin(phase_);
  const double turned = period > 0.0 && period <= kMaxPeriod ? engine_speed * period : 0.0;
  phase_ = std::remainder(phase_ + kFiringsPerTurn * turned, 2.0 * std::numbers::pi);
  return force;
}

}  // namespace gearshift::vehicle
