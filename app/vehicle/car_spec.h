// A car, as a TOML file says it: everything that shifting needs, with a source per value in the file.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/gate/gate.h"

namespace gearshift {

inline constexpr std::size_t kMostTorquePoints = 24;

struct TorquePoint {
  double speed = 0.0;   // [rad/s]
  double torque = 0.0;  // [N m] at full throttle, friction already taken off
};

struct EngineSpec {
  std::array<TorquePoint, kMostTorquePoints> full_load{};  // rising speed; straight lines between, none beyond
  std::size_t points = 0;
  double friction = 9.0;         // [N m] throttle closed, at rest
  double friction_slope = 0.0;   // [N m s] more of it per rad/s
  double friction_square = 0.0;  // [N m s^2] and per (rad/s)^2
  double inertia = 0.15;         // [kg m^2] with flywheel
  double idle = 84.0;            // [rad/s]
  double idle_gain = 0.01;       // [s] throttle per rad/s below idle
  double stall = 37.0;           // [rad/s] it no longer fires below
  double red_line = 680.0;       // [rad/s] over-rev warning
  double limiter = 690.0;        // [rad/s] the fuel is cut here, and comes back below limiter - limiter_band
  double limiter_band = 10.0;    // [rad/s]
  double starter_torque = 60.0;  // [N m] at rest, falling to none at starter_speed
  double starter_speed = 30.0;   // [rad/s]
  double shift_low = 210.0;      // [rad/s] economical shift, from here
  double shift_high = 262.0;     // [rad/s] to here
  double lug_below = 120.0;      // [rad/s] full load harms below
  double shudder = 3.0;          // [N] at a real knob, amplitude of the lever's shaking as the engine dies
};

struct ClutchSpec {
  double capacity = 240.0;      // [N m] closed
  double bite = 0.75;           // [1] pedal: begins to carry below this
  double closed = 0.15;         // [1] pedal: carries all below this; between them quadratic
  double disc_inertia = 0.006;  // [kg m^2] disc and input shaft
};

struct GearboxSpec {
  std::array<double, kMaxGear> ratio{};  // [1] first to ninth; 0: no such gear
  double reverse = 0.0;                  // [1] > 0
  double final_drive = 4.0;              // [1]
  double drag = 0.5;                     // [N m] Coulomb, on the input shaft
  double drag_slope = 0.005;             // [N m s]
  double efficiency = 1.0;               // [1] of the meshing teeth under load; 1 keeps the energy balance bare
};

// One synchroniser for all forward gears; reverse has none.
struct SynchroSpec {
  double friction = 0.10;        // [1] of the cone; worn below the critical value
  double radius = 0.030;         // [m] of the cone, mean
  double cone_angle = 0.11;      // [rad] half-angle
  double cones = 1.0;            // [1] friction surfaces
  double index_radius = 0.035;   // [m] of the blocking teeth
  double pointing_angle = 0.92;  // [rad] half of the angle of their points
  double index_friction = 0.09;  // [1]
  double teeth = 36.0;           // [1] of the dogs
  double dog_speed = 1.0;        // [rad/s] difference up to which dogs go in
  double lever_ratio = 9.0;      // [1] knob to sleeve
  double efficiency = 0.8;       // [1] of the linkage
};

struct BodySpec {
  double mass = 1200.0;               // [kg] with driver
  double rotating = 38.8;             // [kg] of the wheels, at the rim
  double wheel_radius = 0.303;        // [m]
  double resistance = 128.19;         // [N] rolling, at rest: a
  double resistance_slope = 0.0;      // [N s/m] b
  double resistance_square = 0.4764;  // [N s^2/m^2] drag: c
  double brake_force = 9000.0;        // [N] full
  double hand_brake_force = 4500.0;   // [N] full
};

struct CarSpec {
  std::string name;  // the file's name without .toml
  std::string title;
  std::string gate;  // layout that it names
  EngineSpec engine;
  ClutchSpec clutch;
  GearboxSpec gearbox;
  SynchroSpec synchro;
  BodySpec body;
  std::string text;  // the whole file as read, kept for traces
  std::string file;  // for messages
};

// Throws FileError with file, line, key, value and allowed range.
CarSpec read_car(const std::filesystem::path& file);
CarSpec parse_car(std::string_view text, const std::string& file_name);

// Clutch shaft per road speed [rad/m]: ratio times final drive over the wheel's radius; reverse < 0, neutral 0.
double shaft_per_road(const CarSpec& car, int gear) noexcept;
// [N m] at that speed, throttle fully open and closed.
double full_torque(const EngineSpec& engine, double speed) noexcept;
double friction_torque(const EngineSpec& engine, double speed) noexcept;
// [N m] that the clutch can carry at that place of the pedal (0 up, 1 down).
double clutch_capacity(const ClutchSpec& clutch, double pedal) noexcept;

}  // namespace gearshift
