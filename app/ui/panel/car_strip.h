// One line about the car on the lesson card, shown while the control bar is hidden.
#pragma once

#include <string>

#include "app/vehicle/vehicle_state.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::ui {

inline constexpr double kHandBrakeOn = 0.05;  // [1] lever position above which the handbrake lamp is lit

std::string format_speed(const vehicle::VehicleState& car);  // with the car's unit
double slope_percent(const vehicle::VehicleState& car);      // [%] rounded to the displayed precision; positive uphill

// Draws pedals, speeds and active warnings from left to right, wrapped if necessary. The clutch bar changes colour
// while the clutch bites, i.e. slips and transmits torque.
void draw_car_strip(const vehicle::VehicleState& car, int gear, double pedal_help);

}  // namespace gearshift::ui
