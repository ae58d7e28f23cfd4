// The vibration of an engine that labours far below its idle speed, or dies.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::vehicle {

// The first quarter of the way from idle down to the stall speed is smooth: a gentle bite of the clutch dips this far
// under idle control.
inline constexpr double kSmoothDip = 0.25;  // [1]

// [1] 0 to 1, continuous. With w0 = idle - kSmoothDip (idle - stall):
//   depth = (w0 - w) / (w0 - stall), limited to 0..1
//   firing:  depth times the load fraction T_clutch / T_friction(idle), at most 1; 0 if no torque is taken
//   stalled: depth above the stall speed, w / stall below it: 1 as it dies under load, 0 at standstill
// 0 while the starter turns the engine, and with the ignition off.
double engine_shudder(const EngineSpec& engine, const VehicleState& now) noexcept;

// The part of it that reaches the lever: a force along shift, a sine at the firing rate of four cylinders.
class LeverVibration {
 public:
  // amplitude: force at the knob for shudder 1 [N].
  explicit LeverVibration(double amplitude) noexcept : amplitude_(amplitude) {}
  // [N] |force| <= amplitude * shudder. Starts at 0, and is exactly 0 without shudder. engine_speed [rad/s], period
  // [s].
  double step(double shudder, double engine_speed, double period) noexcept;

 private:
  double amplitude_;
  double phase_ = 0.0;  // [rad] of the firing cycle
};

}  // namespace gearshift::vehicle
