// The force sensor at the handle, in raw units.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Section 2.3. Eq (7): f_e = (f_s - 19.04) / 0.1551, f_e in gram-weight (gw), f_s the reading.
#pragma once

namespace gearshift::haptics {

inline constexpr double kNewtonPerGramWeight = 9.80665e-3;

struct ForceSensorModel {
  double offset = 19.04;        // [raw] eq (7)
  double gain = 0.1551;         // [raw/gw] eq (7)
  double resolution_gw = 44.0;  // [gw] resolution, 0.044 kgf in X and Y
  double range_gw = 22000.0;    // [gw] range, 22 kgf in X and Y
  double noise_gw = 0.0;        // [gw] standard deviation before the resolution is applied
};

// Reading [raw] of one axis for a true force [N]: saturated at the range, rounded to the resolution.
double sensor_reading(const ForceSensorModel& sensor, double force, double noise_gw = 0.0) noexcept;

// Force [N] from a reading [raw], by the paper's eq (7).
double force_from_reading(const ForceSensorModel& sensor, double reading) noexcept;

}  // namespace gearshift::haptics
