// The force sensor at the handle, in raw units.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Section 2.3. Eq (7): f_e = (f_s - 19.04) / 0.1551, f_e in gram-weight (gw), f_s the reading.
#pragma once

#include "haptics/files/parameter.h"

namespace gearshift::haptics {

inline constexpr double kNewtonPerGramWeight = 9.80665e-3;

struct ForceSensorModel {
  double offset = 19.04;        // [raw] eq (7)
  double gain = 0.1551;         // [raw/gw] eq (7)
  double resolution_gw = 44.0;  // [gw] 0.044 kgf in x and y
  double range_gw = 22000.0;    // [gw] saturation force, 22 kgf in x and y
  double noise_gw = 0.0;        // [gw] standard deviation of the noise, before rounding to the resolution
  bool operator==(const ForceSensorModel&) const = default;
};

template <>
inline constexpr Parameter<ForceSensorModel> kParameters<ForceSensorModel>[] = {
    {&ForceSensorModel::offset, "offset", "offset", FileRange{-1e9, 1e9}, "Raw reading without a force: eq (7)."},
    {&ForceSensorModel::gain, "gain", "gain_per_gw", FileRange{1e-9, 1e9}, "Raw reading per gram-weight: eq (7)."},
    {&ForceSensorModel::resolution_gw, "resolution_gw", "resolution_gw", FileRange{0.0, 1e6},
     "0.044 kgf (section 2.3)."},
    {&ForceSensorModel::range_gw, "range_gw", "range_gw", FileRange{1e-3, 1e9}, "22 kgf (section 2.3)."},
    {&ForceSensorModel::noise_gw, "noise_gw", "noise_gw", FileRange{0.0, 1e6},
     "Standard deviation of the noise; the paper gives none."},
};
static_assert(DescribesAll<ForceSensorModel>);

// Reading [raw] of one axis for a true force [N]. It saturates at the sensor's range and is rounded to the sensor's
// resolution.
double sensor_reading(const ForceSensorModel& sensor, double force, double noise_gw = 0.0) noexcept;

// Converts a reading [raw] to a force [N] with the paper's eq (7).
double force_from_reading(const ForceSensorModel& sensor, double reading) noexcept;

}  // namespace gearshift::haptics
