// The shift light: advises shifting up above one engine speed, and down below a lower one.
//
// It is simpler than the gear shift indicator of Regulation (EU) 65/2012, Annex I, which estimates the gear with the
// lowest fuel consumption. Here neither fuel nor the torque left in the higher gear is considered: uphill at full
// throttle it still advises shifting up.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::vehicle {

// Hysteresis, so that the light does not flicker: advice needs less to continue than to begin.
inline constexpr double kAdviceHysteresis = 0.05;  // [1] fraction of the engine speed thresholds
// [1] Least throttle for upshift advice to begin, and to continue.
inline constexpr double kUpshiftThrottle = 0.05, kUpshiftThrottleOff = 0.02;
// [1] Least engine load for downshift advice to begin, and to continue.
inline constexpr double kDownshiftLoad = 0.40, kDownshiftLoadOff = 0.30;

// Returns the advice:
// +1: the engine turns faster than EngineSpec::shift_high, the throttle is open, and one gear higher the engine would
//     still turn at lug_below or more.
// -1: the engine turns slower than lug_below under load, and one gear lower it would stay below its red line.
//  0: otherwise, and always in neutral or reverse, with the clutch open or slipping, or with the engine off.
// before: the result of the previous cycle, for the hysteresis.
int shift_advice(const CarSpec& car, const VehicleState& now, int before) noexcept;

}  // namespace gearshift::vehicle
