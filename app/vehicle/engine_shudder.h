// The vibration of an engine that labours far below its idle speed, or dies.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::vehicle {

// Fraction of the speed range from idle down to stall in which the engine does not shudder. Gentle use of the clutch
// slows the engine by up to this fraction before the idle control recovers.
inline constexpr double kSmoothDip = 0.25;  // [1]

// Strength of the vibration [1], 0 to 1, continuous. With engine speed w and w0 = idle - kSmoothDip (idle - stall):
//   depth = (w0 - w) / (w0 - stall), limited to 0..1
//   engine running:      depth * load, with load = (clutch torque / engine friction at idle), limited to 0..1
//   engine not running:  depth from the stall speed up, w / stall below it
// The strength is 0 while the starter turns the engine, and with the ignition off.
double engine_shudder(const EngineSpec& engine, const VehicleState& now) noexcept;

// The engine's vibration at the lever: a sinusoidal force along the shift axis, at the firing rate of four cylinders.
class LeverVibration {
 public:
  // `amplitude`: force at the knob [N] when `shudder` is 1.
  explicit LeverVibration(double amplitude) noexcept : amplitude_(amplitude) {}
  // Returns the force [N]: |force| <= amplitude * shudder. The force starts at 0 and is exactly 0 while `shudder` is 0.
  // `engine_speed` is in rad/s, `period` in seconds.
  double step(double shudder, double engine_speed, double period) noexcept;

 private:
  double amplitude_;
  double phase_ = 0.0;  // [rad] phase of the firing cycle
};

}  // namespace gearshift::vehicle
