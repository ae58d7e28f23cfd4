// The shift light: advises shifting up above one engine speed, and down below a lower one.
//
// It is simpler than the gear shift indicator of Regulation (EU) 65/2012, Annex I, which estimates the gear with the
// lowest fuel consumption. This light considers neither fuel nor the torque left in the higher gear: uphill at full
// throttle it still advises shifting up.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::vehicle {

// Hysteresis against flicker: the conditions are weaker for advice that is already shown.
inline constexpr double kAdviceHysteresis = 0.05;  // [1] fraction of the engine speed thresholds
// [1] Minimum throttle at which upshift advice begins, and at which it continues.
inline constexpr double kUpshiftThrottle = 0.05, kUpshiftThrottleOff = 0.02;
// [1] Minimum engine load at which downshift advice begins, and at which it continues.
inline constexpr double kDownshiftLoad = 0.40, kDownshiftLoadOff = 0.30;

// Returns the advice:
// +1: the engine turns faster than EngineSpec::shift_high, the throttle is open, and one gear higher the engine would
//     still turn at EngineSpec::lug_below or more.
// -1: the engine turns slower than EngineSpec::lug_below under load, and one gear lower it would stay below its red
//     line.
//  0: in all other cases, and always in neutral or reverse, with the clutch open or slipping, or with the engine off.
// `before`: the advice in the previous cycle, for the hysteresis.
int shift_advice(const CarSpec& car, const VehicleState& now, int before) noexcept;

}  // namespace gearshift::vehicle
