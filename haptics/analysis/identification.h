// Mass, damping and stiffness of an axis from its frequency response, and quantities derived from them.
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

namespace gearshift::haptics {

// The paper's eq (8): G(j omega) [m/N] at `frequency` [Hz] for a continuous force, not held between samples.
std::complex<double> compliance(const AxisModel& axis, double frequency) noexcept;

struct AxisFit {
  AxisModel model;
  AxisModel deviation;  // standard uncertainty of mass, damping and stiffness
  double misfit = 0.0;  // [1] about 1 if the points scatter as their deviations predict; above 1 it scales `deviation`
  int points = 0;       // number of points used
};

// Fits 1/G = k - m w^2 + j b w to the measured points by weighted least squares, then refines the fit with the exact
// response to a force that the motors hold between samples. The measured response already accounts for the delay.
// Throws std::invalid_argument with one sentence if there are fewer than three measured points, the fitted mass is not
// positive, or the fit does not converge.
AxisFit fit_axis(const FrequencyResponse& response);

// Highest frequency at which the gain still reaches `gain` [m/N]; 0 if it never does. [Hz]
double frequency_at_gain(const AxisModel& axis, double gain) noexcept;

// Frequency at which the gain has fallen to 1/sqrt 2 (-3 dB) of its static value 1/k; 0 without a spring. [Hz] The
// paper's "100 Hz" does not follow from its own eqs (11) and (12), whose bandwidths are 0.92 and 1.02 Hz.
double bandwidth(const AxisModel& axis) noexcept;

double damping_ratio(const AxisModel& axis) noexcept;  // [1] over-damped if above 1; infinite without a spring
std::array<std::complex<double>, 2> poles(const AxisModel& axis) noexcept;  // [rad/s] slower pole first

// The device's row of Table 2, from its spec().
struct DeviceRow {
  glm::dvec2 range_deg{0.0};      // [deg] angle from stop to stop, select and shift; 0 without a yoke
  double continuous_force = 0.0;  // [N] at the tip, weaker axis; printed in the paper as "10.83 Nm"
  double counts_per_deg = 0.0;    // [1/deg] 0 without a yoke or an encoder
  double step = 0.0;              // [m] motion of the tip per encoder count
};
DeviceRow device_row(const DeviceSpec& spec) noexcept;

}  // namespace gearshift::haptics
