// A car as described by its TOML file: everything that affects shifting. The file names a source for each value.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/vehicle/speed_unit.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"

namespace gearshift::vehicle {

inline constexpr std::size_t kMaxTorquePoints = 24;
inline constexpr double kAirTemperature = 40.0;  // [C] around the clutch of a warm car; engineering value
// [C] Temperatures of the clutch from which it smells, from which it loses capacity, and at which it has none; in between,
// capacity falls in proportion. BeamNG warns at 200 C, fades at 300 C, and breaks the clutch at 500 C.
inline constexpr double kClutchSmells = 200.0, kClutchFades = 300.0, kClutchBurnt = 500.0;

struct TorquePoint {
  double speed = 0.0;   // [rad/s]
  double torque = 0.0;  // [N m] torque at full throttle, net of engine friction
};

struct EngineSpec {
  std::array<TorquePoint, kMaxTorquePoints> full_load{};  // in order of speed; linear between points, zero outside
  std::size_t points = 0;
  double friction = 9.0;            // [N m] engine friction at standstill, throttle closed
  double friction_slope = 0.0;      // [N m s] increase of friction per rad/s
  double friction_square = 0.0;     // [N m s^2] increase of friction per (rad/s)^2
  double compression = 0.0;         // [N m] further friction of an engine at rest, which fades as it turns
  double inertia = 0.15;            // [kg m^2] including the flywheel
  double idle = 84.0;               // [rad/s]
  double idle_gain = 0.01;          // [s] extra throttle per rad/s below idle
  double idle_integral_gain = 0.0;  // [1] extra throttle per rad/s below idle and second
  double idle_lift = 0.0;        // [rad/s] how far the idle control raises its speed while a slipping clutch takes hold
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
  double capacity = 240.0;        // [N m] largest torque the clutch transmits, pedal up
  double bite = 0.75;             // [1] pedal position below which the clutch transmits torque
  double closed = 0.15;           // [1] pedal position below which capacity is full; quadratic between bite and closed
  double disc_inertia = 0.006;    // [kg m^2] disc plus input shaft
  double heat_capacity = 2000.0;  // [J/K] of disc, pressure plate and flywheel's surface together
  double cooling = 5.0;           // [W/K] to the air around them
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
  double friction = 0.10;        // [1] cone friction; a ring that has less than it needs to block counts as worn
  double radius = 0.030;         // [m] mean radius of the cone
  double cone_angle = 0.11;      // [rad] half-angle
  int cones = 1;                 // [1] number of friction surfaces
  double index_radius = 0.035;   // [m] radius of the blocking teeth
  double pointing_angle = 0.92;  // [rad] half-angle of the blocking teeth's points
  double index_friction = 0.09;  // [1]
  int teeth = 36;                // [1] number of dog teeth
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

// How keys move the car's pedals, see KeyboardPedals in car_load.h.
struct PedalTiming {
  double pedal_time = 0.25;  // [s] time for the full pedal travel
  double slip_time = 4.0;    // [s] time in which the rising clutch pedal passes from the bite point to full capacity
};

struct CarSpec {
  std::string name;  // the file's name without .toml
  std::string title;
  std::string gate;  // name of the gate layout
  SpeedUnit speed_unit = SpeedUnit::km_per_h;
  EngineSpec engine;
  ClutchSpec clutch;
  GearboxSpec gearbox;
  SynchroSpec synchro;
  BodySpec body;
  std::string text;  // text of the whole file, stored in traces
  std::string file;  // for messages
};

// [rad/s] A faster engine has so little compression left that it counts as none.
inline constexpr double kMaxCompressedSpeed = 80.0;

// Both functions throw FileError with file, line, key, value and allowed range.
CarSpec read_car(const std::filesystem::path& file);
CarSpec parse_car(std::string_view text, const std::string& file_name);

// Shaft speed divided by road speed [rad/m], i.e. ratio * final drive / wheel radius. Negative in reverse, 0 in
// neutral.
double shaft_per_road(const CarSpec& car, int gear) noexcept;
// Torque at full throttle, net of engine friction [N m]. `speed` is in rad/s.
double full_torque(const EngineSpec& engine, double speed) noexcept;
// Highest speed that the car keeps on a level road: engine and resistance are in balance, or the limiter cuts in [m/s].
double top_speed(const CarSpec& car) noexcept;
// Engine friction with the throttle closed, against the rotation in either direction [N m]. `speed` is in rad/s.
double friction_torque(const EngineSpec& engine, double speed) noexcept;

}  // namespace gearshift::vehicle

// The keys of car files. full_load and the forward ratios are lists, which car_spec.cpp reads.
namespace gearshift::haptics {

template <>
inline constexpr Parameter<vehicle::EngineSpec> kParameters<vehicle::EngineSpec>[] = {
    {&vehicle::EngineSpec::friction, "friction", "friction_nm", FileRange{0.0, 5000.0},
     "Motoring torque at standstill."},
    {&vehicle::EngineSpec::friction_slope, "friction_slope", "friction_nm_per_krpm",
     FileRange{0.0, 5000.0, file_unit::kPerKrpm}, "Increase per 1000 rpm."},
    {&vehicle::EngineSpec::friction_square, "friction_square", "friction_nm_per_krpm2",
     FileRange{0.0, 5000.0, file_unit::kPerKrpmSquared}, "Increase per (1000 rpm)^2."},
    {&vehicle::EngineSpec::compression, "compression", "compression_nm", FileRange{0.0, 5000.0},
     "Holds the engine at rest."},
    {&vehicle::EngineSpec::inertia, "inertia", "inertia_kgm2", FileRange{0.01, 10.0}, "With the flywheel."},
    {&vehicle::EngineSpec::idle, "idle", "idle_rpm", FileRange{50.0, 20000.0, file_unit::kRpm}, ""},
    {&vehicle::EngineSpec::idle_gain, "idle_gain", "idle_throttle_per_krpm", FileRange{0.1, 100.0, file_unit::kPerKrpm},
     "Of idle control: extra throttle."},
    {&vehicle::EngineSpec::idle_integral_gain, "idle_integral_gain", "idle_throttle_per_krpm_s",
     FileRange{0.0, 100.0, file_unit::kPerKrpm}, "The same, integrated."},
    {&vehicle::EngineSpec::idle_lift, "idle_lift", "idle_lift_rpm", FileRange{0.0, 1000.0, file_unit::kRpm},
     "Idle rises while the clutch slips."},
    {&vehicle::EngineSpec::stall, "stall", "stall_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Below it, the engine dies."},
    {&vehicle::EngineSpec::red_line, "red_line", "red_line_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Over-rev warning."},
    {&vehicle::EngineSpec::limiter, "limiter", "limiter_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Above it, fuel is cut."},
    {&vehicle::EngineSpec::limiter_band, "limiter_band", "limiter_band_rpm", FileRange{1.0, 1000.0, file_unit::kRpm},
     "Until the fuel returns."},
    {&vehicle::EngineSpec::starter_torque, "starter_torque", "starter_nm", FileRange{1.0, 1000.0}, "At standstill."},
    {&vehicle::EngineSpec::starter_speed, "starter_speed", "starter_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Starter's speed without load."},
    {&vehicle::EngineSpec::shift_low, "shift_low", "shift_from_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Lower end of economical upshifts."},
    {&vehicle::EngineSpec::shift_high, "shift_high", "shift_to_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Upper end."},
    {&vehicle::EngineSpec::lug_below, "lug_below", "lug_below_rpm", FileRange{50.0, 20000.0, file_unit::kRpm},
     "Full load below it harms the engine."},
    {&vehicle::EngineSpec::shudder, "shudder", "shudder_n", FileRange{0.0, 10.0}, "Vibration at the knob as it dies."},
};
static_assert(describes_all(&vehicle::EngineSpec::full_load, &vehicle::EngineSpec::points));

template <>
inline constexpr Parameter<vehicle::ClutchSpec> kParameters<vehicle::ClutchSpec>[] = {
    {&vehicle::ClutchSpec::capacity, "capacity", "capacity_nm", FileRange{1.0, 10000.0}, "Pedal up."},
    {&vehicle::ClutchSpec::bite, "bite", "bite_pedal", FileRange{0.0, 1.0}, "Pedal where torque begins; 1: down."},
    {&vehicle::ClutchSpec::closed, "closed", "closed_pedal", FileRange{0.0, 1.0},
     "Pedal of full capacity; quadratic between."},
    {&vehicle::ClutchSpec::disc_inertia, "disc_inertia", "disc_inertia_kgm2", FileRange{0.0005, 1.0},
     "Disc and input shaft."},
    {&vehicle::ClutchSpec::heat_capacity, "heat_capacity", "heat_capacity_j_per_k", FileRange{10.0, 1e6},
     "Of disc, plate and flywheel's surface."},
    {&vehicle::ClutchSpec::cooling, "cooling", "cooling_w_per_k", FileRange{0.0, 1000.0}, "To the air."},
};
static_assert(DescribesAll<vehicle::ClutchSpec>);

template <>
inline constexpr Parameter<vehicle::GearboxSpec> kParameters<vehicle::GearboxSpec>[] = {
    {&vehicle::GearboxSpec::reverse, "reverse", "ratio_r", FileRange{0.1, 20.0}, "Reverse."},
    {&vehicle::GearboxSpec::final_drive, "final_drive", "final_drive", FileRange{0.1, 20.0}, ""},
    {&vehicle::GearboxSpec::drag, "drag", "drag_nm", FileRange{0.0, 20.0}, "Friction of the input shaft."},
    {&vehicle::GearboxSpec::drag_slope, "drag_slope", "drag_nm_per_krpm", FileRange{0.0, 20.0, file_unit::kPerKrpm},
     "Increase per 1000 rpm."},
    {&vehicle::GearboxSpec::efficiency, "efficiency", "efficiency", FileRange{0.5, 1.0}, "Meshing teeth; 1: lossless."},
};
static_assert(describes_all(&vehicle::GearboxSpec::ratio));

template <>
inline constexpr Parameter<vehicle::SynchroSpec> kParameters<vehicle::SynchroSpec>[] = {
    {&vehicle::SynchroSpec::friction, "friction", "friction", FileRange{0.01, 0.5},
     "Of the cone; a worn ring has less."},
    {&vehicle::SynchroSpec::radius, "radius", "radius_mm", FileRange{5.0, 200.0, file_unit::kMillimetres},
     "Of the cone."},
    {&vehicle::SynchroSpec::cone_angle, "cone_angle", "cone_half_angle_deg", FileRange{3.0, 20.0, file_unit::kDegrees},
     "Of the cone."},
    {&vehicle::SynchroSpec::cones, "cones", "cones", FileRange{1.0, 4.0}, "Friction surfaces."},
    {&vehicle::SynchroSpec::index_radius, "index_radius", "index_radius_mm",
     FileRange{5.0, 200.0, file_unit::kMillimetres}, "Blocking teeth."},
    {&vehicle::SynchroSpec::pointing_angle, "pointing_angle", "pointing_half_angle_deg",
     FileRange{30.0, 70.0, file_unit::kDegrees}, "Their points."},
    {&vehicle::SynchroSpec::index_friction, "index_friction", "index_friction", FileRange{0.01, 0.5},
     "Of these teeth."},
    {&vehicle::SynchroSpec::teeth, "teeth", "teeth", FileRange{6.0, 120.0}, "Dogs."},
    {&vehicle::SynchroSpec::dog_speed, "dog_speed", "dog_rpm", FileRange{0.5, 100.0, file_unit::kRpm},
     "Largest difference at which dogs engage."},
    {&vehicle::SynchroSpec::lever_ratio, "lever_ratio", "lever_ratio", FileRange{1.0, 30.0},
     "Knob travel divided by sleeve travel."},
    {&vehicle::SynchroSpec::efficiency, "efficiency", "efficiency", FileRange{0.5, 1.0},
     "Linkage from knob to sleeve."},
};
static_assert(DescribesAll<vehicle::SynchroSpec>);

// In files of bindings.
template <>
inline constexpr Parameter<vehicle::PedalTiming> kParameters<vehicle::PedalTiming>[] = {
    {&vehicle::PedalTiming::pedal_time, "pedal_time", "pedal_key_s", FileRange{0.01, 5.0}, "Full travel of a pedal."},
    {&vehicle::PedalTiming::slip_time, "slip_time", "clutch_key_slip_s", FileRange{0.01, 10.0},
     "The clutch pedal, from the bite point to the full capacity."},
};
static_assert(DescribesAll<vehicle::PedalTiming>);

template <>
inline constexpr Parameter<vehicle::BodySpec> kParameters<vehicle::BodySpec>[] = {
    {&vehicle::BodySpec::mass, "mass", "mass_kg", FileRange{100.0, 60000.0}, "With driver."},
    {&vehicle::BodySpec::rotating, "rotating", "rotating_kg", FileRange{0.0, 5000.0}, "Wheels, as a mass at the rim."},
    {&vehicle::BodySpec::wheel_radius, "wheel_radius", "wheel_radius_mm",
     FileRange{100.0, 1000.0, file_unit::kMillimetres}, "Driven wheels."},
    {&vehicle::BodySpec::resistance, "resistance", "resistance_n", FileRange{0.0, 20000.0}, "At standstill."},
    {&vehicle::BodySpec::resistance_slope, "resistance_slope", "resistance_n_per_mps", FileRange{0.0, 100.0},
     "Increase per m/s."},
    {&vehicle::BodySpec::resistance_square, "resistance_square", "resistance_n_per_mps2", FileRange{0.0, 20.0},
     "Air drag per (m/s)^2."},
    {&vehicle::BodySpec::brake_force, "brake_force", "brake_n", FileRange{0.0, 1e6}, "At the rim, pedal down."},
    {&vehicle::BodySpec::hand_brake_force, "hand_brake_force", "hand_brake_n", FileRange{0.0, 1e6},
     "At the rim, handbrake up."},
};
static_assert(DescribesAll<vehicle::BodySpec>);

template <>
inline constexpr Parameter<vehicle::CarSpec, vehicle::SpeedUnit> kParameters<vehicle::CarSpec>[] = {
    {&vehicle::CarSpec::speed_unit, "speed_unit", "speed_unit", FileRange{}, "Of dials, prompts and feedback."},
};
static_assert(describes_all(&vehicle::CarSpec::name, &vehicle::CarSpec::title, &vehicle::CarSpec::gate,
                            &vehicle::CarSpec::engine, &vehicle::CarSpec::clutch, &vehicle::CarSpec::gearbox,
                            &vehicle::CarSpec::synchro, &vehicle::CarSpec::body, &vehicle::CarSpec::text,
                            &vehicle::CarSpec::file));

}  // namespace gearshift::haptics
