// The car in a line, on a lesson's card, where the panel's bar is hidden.
#pragma once

#include <string>

#include "app/vehicle/vehicle_state.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

inline constexpr double kHandBrakeOn = 0.05;  // [1] its lamp is lit above

double slope_percent(const VehicleState& car);  // as printed, uphill +

// Pedals, speeds and what is on, from the left edge; on as many lines as it needs. The clutch's bar is another colour
// while the clutch slips: that is where it bites.
void draw_car_strip(const VehicleState& car, int gear);

}  // namespace gearshift
