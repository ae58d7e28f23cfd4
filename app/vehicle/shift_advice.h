// The shift light: two limits of engine speed, above which the next gear up is advised, and below which the next one
// down.
//
// Less than the gear shift indicator of Regulation (EU) 65/2012, Annex I, which it stands for: that one estimates in
// which gear the car would burn less. Here no fuel is estimated, and nothing is asked of the torque that is left in the
// higher gear: who drives uphill with the throttle open is told to shift up too.
#pragma once

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

// Where an advice comes, and where one that is lit goes out again: between them it stays as it was, and so it does not
// flicker.
inline constexpr double kAdviceBand = 0.05;                        // [1] of the speeds that are compared
inline constexpr double kPulls = 0.05, kNoLongerPulls = 0.02;      // [1] throttle, for a gear up
inline constexpr double kLabours = 0.40, kNoLongerLabours = 0.30;  // [1] engine's load, for a gear down

// +1: the engine turns faster than EngineSpec::shift_high, the throttle is open, and one gear up it would still turn at
//     lug_below or more.
// -1: it turns slower than lug_below under load, and one gear down it would stay below its red line.
//  0: neither; and always without a gear ahead, with a clutch that is open or slips, while the engine does not fire.
// before: the answer of the cycle before, for the bands above.
int shift_advice(const CarSpec& car, const VehicleState& now, int before) noexcept;

}  // namespace gearshift
