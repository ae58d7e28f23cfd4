// Calibration of the force sensor with weights.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Section 2.3: no load and six standard weights in eight directions of the x-y plane; eq (7).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/joystick/force_sensor.h"

namespace gearshift::haptics {

inline constexpr std::array<double, 7> kCalibrationWeights{0, 100, 200, 300, 500, 750, 1000};  // [gw]
inline constexpr int kCalibrationDirections = 8;                                               // 45 deg apart

struct Weighing {
  double weight = 0.0;      // [gw]
  int direction = 0;        // 0 to 7: angle from +x towards +y, in steps of 45 deg
  glm::dvec2 reading{0.0};  // [raw] sensor reading f_s of both axes
};

// Simulates the calibration: loads two sensors with every weight in every direction and averages `samples` readings (1
// to 100000) of each. Throws std::invalid_argument if `samples` is out of range.
std::vector<Weighing> weigh(const ForceSensorModel& x, const ForceSensorModel& y, int samples, std::uint64_t seed);

// Line fitted to one axis, reading f_s = offset + gain * force f_e: the inverse of the paper's eq (7).
struct SensorLine {
  double offset = 0.0, offset_deviation = 0.0;  // [raw] reading without load, and its standard uncertainty
  double gain = 0.0, gain_deviation = 0.0;      // [raw/gw]
  double nonlinearity = 0.0;                    // [gw] largest deviation of a reading from the line
};

struct SensorCalibration {
  SensorLine x, y;
  double direction_spread = 0.0;  // [1] largest deviation from 1 of a direction's ratio of calibrated force to weight
  double cross_force = 0.0;       // [gw] largest force measured perpendicular to the weight
};

// Throws std::invalid_argument if an axis has fewer than three different forces.
SensorCalibration calibrate_sensor(std::span<const Weighing> weighings);

}  // namespace gearshift::haptics
