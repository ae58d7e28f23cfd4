// A car as described by its TOML file: everything that affects shifting. The file names a source for each value.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/gate/gate.h"

namespace gearshift::vehicle {

inline constexpr std::size_t kMaxTorquePoints = 24;

struct TorquePoint {
  double speed = 0.0;   // [rad/s]
  double torque = 0.0;  // [N m] torque at full throttle, net of engine friction
};

struct EngineSpec {
  std::array<TorquePoint, kMaxTorquePoints> full_load{};  // in order of speed; linear between points, zero outside
  std::size_t points = 0;
  double friction = 9.0;         // [N m] engine friction at standstill, throttle closed
  double friction_slope = 0.0;   // [N m s] increase of friction per rad/s
  double friction_square = 0.0;  // [N m s^2] increase of friction per (rad/s)^2
  double inertia = 0.15;         // [kg m^2] including the flywheel
  double idle = 84.0;            // [rad/s]
  double idle_gain = 0.01;       // [s] extra throttle per rad/s below idle
  double stall = 37.0;           // [rad/s] below this speed the engine stops firing
  double red_line = 680.0;       // [rad/s] over-rev warning
  double limiter = 690.0;        // [rad/s] fuel is cut above this speed and restored below limiter - limiter_band
  double limiter_band = 10.0;    // [rad/s]
  double starter_torque = 60.0;  // [N m] starter torque at standstill; falls to zero at starter_speed
  double starter_speed = 30.0;   // [rad/s]
  double shift_low = 210.0;      // [rad/s] lower end of the band for economical upshifts
  double shift_high = 262.0;     // [rad/s] upper end of the band for economical upshifts
  double lug_below = 120.0;      // [rad/s] below this speed, full load harms the engine
  double shudder = 3.0;          // [N] amplitude of the vibration at the knob of a real car while the engine dies
};

struct ClutchSpec {
  double capacity = 240.0;      // [N m] largest torque the clutch transmits, pedal up
  double bite = 0.75;           // [1] pedal position below which the clutch transmits torque
  double closed = 0.15;         // [1] pedal position below which capacity is full; quadratic between bite and closed
  double disc_inertia = 0.006;  // [kg m^2] disc plus input shaft
};

struct GearboxSpec {
  std::array<double, haptics::kMaxGear> ratio{};  // [1] ratios of first to ninth gear; 0: no such gear
  double reverse = 0.0;                           // [1] > 0
  double final_drive = 4.0;                       // [1]
  double drag = 0.5;                              // [N m] Coulomb friction on the input shaft
  double drag_slope = 0.005;                      // [N m s]
  double efficiency = 1.0;                        // [1] efficiency of the meshing teeth under load; 1: lossless
};

// All forward gears share these values; reverse has no synchroniser.
struct SynchroSpec {
  double friction = 0.10;        // [1] cone friction; below critical_friction() the synchroniser counts as worn
  double radius = 0.030;         // [m] mean radius of the cone
  double cone_angle = 0.11;      // [rad] half-angle
  double cones = 1.0;            // [1] number of friction surfaces
  double index_radius = 0.035;   // [m] radius of the blocking teeth
  double pointing_angle = 0.92;  // [rad] half-angle of the blocking teeth's points
  double index_friction = 0.09;  // [1]
  double teeth = 36.0;           // [1] number of dog teeth
  double dog_speed = 1.0;        // [rad/s] largest speed difference at which the dogs engage
  double lever_ratio = 9.0;      // [1] knob travel divided by sleeve travel
  double efficiency = 0.8;       // [1] efficiency of the linkage
};

struct BodySpec {
  double mass = 1200.0;               // [kg] with driver
  double rotating = 38.8;             // [kg] inertia of the wheels, as a mass at the rim
  double wheel_radius = 0.303;        // [m]
  double resistance = 128.19;         // [N] rolling resistance, independent of speed
  double resistance_slope = 0.0;      // [N s/m] part of the resistance proportional to speed
  double resistance_square = 0.4764;  // [N s^2/m^2] air drag, proportional to speed squared
  double brake_force = 9000.0;        // [N] brake force with the pedal fully down
  double hand_brake_force = 4500.0;   // [N] brake force with the lever fully up
};

struct CarSpec {
  std::string name;  // the file's name without .toml
  std::string title;
  std::string gate;  // name of the gate layout
  EngineSpec engine;
  ClutchSpec clutch;
  GearboxSpec gearbox;
  SynchroSpec synchro;
  BodySpec body;
  std::string text;  // text of the whole file, stored in traces
  std::string file;  // for messages
};

// Both functions throw FileError with file, line, key, value and allowed range.
CarSpec read_car(const std::filesystem::path& file);
CarSpec parse_car(std::string_view text, const std::string& file_name);

// Shaft speed divided by road speed [rad/m], i.e. ratio * final drive / wheel radius. Negative in reverse, 0 in
// neutral.
double shaft_per_road(const CarSpec& car, int gear) noexcept;
// Torque at full throttle, net of engine friction [N m]. `speed` is in rad/s.
double full_torque(const EngineSpec& engine, double speed) noexcept;
// Engine friction with the throttle closed [N m]. `speed` is in rad/s.
double friction_torque(const EngineSpec& engine, double speed) noexcept;
// Largest torque that the clutch can transmit [N m]. `pedal` is 0 when released and 1 when fully pressed.
double clutch_capacity(const ClutchSpec& clutch, double pedal) noexcept;

}  // namespace gearshift::vehicle
