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

// Position per force, G(j omega) [m/N] of the paper's eq (8), at `frequency` [Hz]. The force is continuous, not held
// between samples.
std::complex<double> compliance(const AxisModel& axis, double frequency) noexcept;

struct AxisFit {
  AxisModel model;
  AxisModel deviation;              // standard uncertainty of mass, damping and stiffness
  double friction = 0.0;            // [N] dry friction; noise may make it slightly negative
  double friction_deviation = 0.0;  // [N] its standard uncertainty
  double misfit =
      0.0;         // [1] scatter of the points relative to their deviations; beyond chance it scales the uncertainty
  int points = 0;  // number of points used in the fit
};

// Fits mass m, damping b, stiffness k and dry friction to the measured points by weighted least squares, with the exact
// response to a force that the motors hold between samples. The measured response already accounts for the delay.
// Friction counts as damping of 4 F / (pi v) at the speed v of each point's motion, which tells it from b; points at which
// friction holds the lever at each turn are left out. Throws std::invalid_argument with one sentence if fewer than three
// points remain, the fitted mass is not positive, or the fit does not converge.
AxisFit fit_axis(const FrequencyResponse& response);

// Highest frequency [Hz] at which the axis still moves `gain` [m] per newton; 0 if it never does.
double frequency_at_gain(const AxisModel& axis, double gain) noexcept;

// Frequency [Hz] at which the gain has fallen to 1/sqrt 2 (-3 dB) of its static value 1/stiffness; 0 without a spring.
// The paper states 100 Hz, but its own eqs (11) and (12) give 0.92 and 1.02 Hz.
double bandwidth(const AxisModel& axis) noexcept;

double damping_ratio(const AxisModel& axis) noexcept;  // [1] over-damped if above 1; infinite without a spring
std::array<std::complex<double>, 2> poles(const AxisModel& axis) noexcept;  // [rad/s] the slower pole comes first

// One device's values for Table 2 of the paper, computed from its spec().
struct DeviceRow {
  glm::dvec2 range_deg{0.0};      // [deg] angle from stop to stop of the select and shift axis; 0 without a yoke
  double continuous_force = 0.0;  // [N] at the tip, for the weaker axis; printed in the paper as "10.83 Nm"
  double counts_per_deg = 0.0;    // [1/deg] encoder counts per degree; 0 without a yoke or an encoder
  double step = 0.0;              // [m] motion of the tip per encoder count
};
DeviceRow device_row(const DeviceSpec& spec) noexcept;

}  // namespace gearshift::haptics
