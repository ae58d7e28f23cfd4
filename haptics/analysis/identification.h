// Mass, damping and stiffness of an axis from its frequency response, and what follows from them.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Section 2.4: eqs (8), (11), (12), Table 2.
#pragma once

#include <array>
#include <complex>

#include <glm/vec2.hpp>

#include "haptics/analysis/frequency_sweep.h"
#include "haptics/device/haptic_device.h"
#include "haptics/joystick/plant.h"

namespace gearshift {

// Eq (8), G(j omega) of a force that does not stand still. [m/N] frequency [Hz]
std::complex<double> compliance(const AxisModel& axis, double frequency) noexcept;

struct AxisFit {
  AxisModel model;
  AxisModel deviation;  // standard uncertainty of each of its three numbers
  double misfit = 0.0;  // [1] about 1 where the points scatter as their deviations say; above it, it is in `deviation`
  int points = 0;       // that were used
};

// Weighted least squares of 1/G = k - m w^2 + j b w over the measured points, then refined on what a sampled sinusoid
// really does: the motors hold their force, exactly stepped. Delay is already in the response.
// Throws std::invalid_argument in one sentence: fewer than three measured points, no positive mass in them, or a fit
// that does not settle.
AxisFit fit_axis(const FrequencyResponse& response);

// Highest frequency at which the gain is still `gain` [m/N]; 0 where it never is. [Hz]
double frequency_at_gain(const AxisModel& axis, double gain) noexcept;

// Where the gain has fallen to 1/sqrt 2 (-3 dB) of that at rest, 1/k. [Hz] 0 without a spring. The paper's "100 Hz"
// does not follow from its own (11) and (12), whose bandwidths are 0.92 and 1.02 Hz.
double bandwidth(const AxisModel& axis) noexcept;

double damping_ratio(const AxisModel& axis) noexcept;  // [1] above 1 over-damped, infinite without a spring
std::array<std::complex<double>, 2> poles(const AxisModel& axis) noexcept;  // [rad/s] the slower first

// The device's row of Table 2, of what spec() knows.
struct DeviceRow {
  glm::dvec2 range_deg{0.0};      // [deg] from stop to stop, select and shift; 0 without a yoke
  double continuous_force = 0.0;  // [N] at the tip, the weaker axis: what the paper prints as "10.83 Nm"
  double counts_per_deg = 0.0;    // [1/deg] 0 without a yoke or an encoder
  double step = 0.0;              // [m] of the encoder at the tip
};
DeviceRow device_row(const DeviceSpec& spec) noexcept;

}  // namespace gearshift
