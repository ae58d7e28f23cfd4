// How an engine shakes its car when it labours far below its idle, or dies.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

// Of the way from idle down to the speed at which it dies, the first quarter is smooth: so deep an idle control lets it
// dip when a clutch bites gently.
inline constexpr double kSmoothDip = 0.25;  // [1]

// [1] 0 to 1, continuous. With w0 = idle - kSmoothDip (idle - stall):
//   depth = (w0 - w) / (w0 - stall), between 0 and 1
//   it fires:   depth times the share T_clutch / T_friction(idle), at most 1, of a clutch that takes torque from it
//   it stalled: depth above the stall speed, w / stall below: 1 as it dies under load, gone once it stands
// 0 while the starter turns it, and without ignition.
double engine_shudder(const EngineSpec& engine, const VehicleState& now) noexcept;

// What of it comes up the lever: a force along shift, sine over the firings of four cylinders.
class LeverShake {
 public:
  // amplitude: of a whole shudder [N] at the knob.
  explicit LeverShake(double amplitude) noexcept : amplitude_(amplitude) {}
  // [N] |force| <= amplitude * shudder; begins at 0, and is exactly 0 without shudder. engine_speed [rad/s], period [s].
  double step(double shudder, double engine_speed, double period) noexcept;

 private:
  double amplitude_;
  double phase_ = 0.0;  // [rad] of the firings
};

}  // namespace gearshift
