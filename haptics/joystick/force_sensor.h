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
  double resolution_gw = 44.0;  // [gw] 0.044 kgf in x and y
  double range_gw = 22000.0;    // [gw] saturation force, 22 kgf in x and y
  double noise_gw = 0.0;        // [gw] standard deviation of the noise, before rounding to the resolution
};

// Reading [raw] of one axis for a true force [N]. It saturates at the sensor's range and is rounded to the sensor's
// resolution.
double sensor_reading(const ForceSensorModel& sensor, double force, double noise_gw = 0.0) noexcept;

// Converts a reading [raw] to a force [N] with the paper's eq (7).
double force_from_reading(const ForceSensorModel& sensor, double reading) noexcept;

}  // namespace gearshift::haptics
