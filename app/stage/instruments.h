// What the car says to its driver: needles, gear, lamps; and where wheel, pedals and handbrake stand.
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "app/vehicle/vehicle_state.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

inline constexpr double kTachTop = 8000.0;  // [1/min] end of the scale
inline constexpr double kSpeedTop = 220.0;  // [km/h]

// Angle of a needle about its axis: 135 deg at zero, 270 deg less at the end of the scale; it stays on its scale.
double needle_angle(double value, double top) noexcept;  // [rad] counter-clockwise +

double tach_angle(const VehicleState& car) noexcept;   // [rad]
double speed_angle(const VehicleState& car) noexcept;  // [rad] the dial knows no direction

// What shakes with an engine that labours or dies: a swing between -1 and 1 times its shudder, the same at the same
// time [s], 0 without shudder. 13 and 17 Hz: fast, and slow enough for a picture's frames.
double tremble(const VehicleState& car, double time) noexcept;
inline constexpr double kNeedleTremble = 0.035;  // [rad] of a whole shudder
inline constexpr double kLeverTremble = 0.0007;  // [m] at the knob

// The display shows "N" at rest; its atlas has the fields R N 1 ... 9 side by side. Shift of uv0 to a gear's field.
glm::vec2 gear_field(int gear) noexcept;

// Travel of the controls. [rad]
double pedal_angle(double pressed) noexcept;      // about +x
double hand_brake_angle(double pulled) noexcept;  // about +x, on top of the angle at rest

enum class Lamp : int { oil, battery, hand_brake, engine, stall, turn_left, turn_right, lever };
inline constexpr int kLampCount = 8;
// Names of the nodes, in the order of Lamp.
inline constexpr std::array<const char*, kLampCount> kLampNodes = {
    "LampOil", "LampBattery", "LampHandbrake", "LampEngine", "LampStall", "LampTurnLeft", "LampTurnRight", "LampLever"};

inline constexpr double kBlinkRate = 1.5;  // [Hz] of the indicators: 60 to 120 a minute (UN R6)

// 0 dark, 1 lit.
float lamp_light(Lamp lamp, const VehicleState& car, const HapticSnapshot& lever, double time) noexcept;

}  // namespace gearshift
