// Instruments (needles, gear display, lamps) and the positions of pedals and handbrake.
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "app/vehicle/vehicle_state.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::cabin {

// The printed scale of a dial, from 0 to `top`. `step` is the distance between two numbers; there are small ticks between.
struct DialScale {
  double top = 0.0, step = 0.0;
  int ticks = 2;  // number of intervals between two numbers
  bool operator==(const DialScale&) const = default;
};

// [1/min] Ends at least a tenth beyond the car's red line [rad/s]. For 0 (no car), the dial of the model file: 8000.
DialScale tach_scale(double red_line) noexcept;
// [km/h] or [mph] Ends at least a seventh beyond the car's top speed [m/s]. For 0 (no car), the dial of the model file.
DialScale speed_scale(double top_speed, vehicle::SpeedUnit unit) noexcept;

// Angle of a needle about its axis: 135 deg at zero, -135 deg at the end of the scale, `top`. The angle is limited to
// the scale.
double needle_angle(double value, double top) noexcept;  // [rad] counter-clockwise +

double tach_angle(const vehicle::VehicleState& car) noexcept;   // [rad]
double speed_angle(const vehicle::VehicleState& car) noexcept;  // [rad] the same forward and in reverse

// Vibration of parts while the engine labours or stalls: car.shudder times an oscillation between -1 and 1 that depends
// only on time [s]. The oscillation's frequencies, 13 and 17 Hz, are low enough for the frame rate.
double vibration(const vehicle::VehicleState& car, double time) noexcept;
inline constexpr double kNeedleVibration = 0.035;  // [rad] amplitude of the needles at full shudder
inline constexpr double kLeverVibration = 0.0007;  // [m] amplitude of the knob at full shudder

// Offset of uv0 that shows the field of a gear. The display's atlas has the fields R N 1 ... 9 side by side; offset 0
// shows "N".
glm::vec2 gear_field(int gear) noexcept;

// Angles [rad] of the controls.
double pedal_angle(double pressed) noexcept;      // about +x
double hand_brake_angle(double pulled) noexcept;  // about +x, added to the angle at rest

enum class Lamp : int { oil, battery, hand_brake, engine, stall, turn_left, turn_right, lever };
inline constexpr int kLampCount = 8;
// Names of the lamps' nodes, in the order of the enum Lamp.
inline constexpr std::array<const char*, kLampCount> kLampNodes = {
    "LampOil", "LampBattery", "LampHandbrake", "LampEngine", "LampStall", "LampTurnLeft", "LampTurnRight", "LampLever"};

// Brightness of a lamp, from 0 (dark) to 1 (lit).
float lamp_light(Lamp lamp, const vehicle::VehicleState& car, const haptics::HapticSnapshot& lever) noexcept;

}  // namespace gearshift::cabin
