// Identifies a lever's dynamics and delay from short force pulses: fits the exact response of a mass with damping and a
// spring and dry friction by least squares.
//
//   x'' + damping x' + stiffness x = gain (u(t - delay) - friction sign x'),   u = the pulse's steps of force
//
// The gain and each pulse's starting position follow in closed form from the other four parameters (variable
// projection), which are found by the Levenberg-Marquardt method.
//
// This work is based on:
// Gene Golub, Victor Pereyra. The Differentiation of Pseudo-Inverses and Nonlinear Least Squares Problems Whose Variables
// Separate. 1973
// Donald Marquardt. An Algorithm for Least-Squares Estimation of Nonlinear Parameters. 1963
#pragma once

#include <span>
#include <vector>

namespace gearshift::haptics {

struct PulseSample {
  double time = 0.0;      // [s] time since the pulse was sent
  double position = 0.0;  // position relative to the rest position, in any unit of length
};

struct PulseStep {
  double time = 0.0;   // [s] when the force was sent
  double force = 0.0;  // [1] -1 to 1, fraction of the full force, until the next step
};

struct Pulse {
  std::vector<PulseStep> steps;  // before the first, there is no force
  std::vector<PulseSample> samples;
};

struct PulseFit {
  double gain = 0.0;       // [length/s^2] acceleration at magnitude 1
  double damping = 0.0;    // [1/s] damping divided by mass
  double stiffness = 0.0;  // [1/s^2] stiffness divided by mass
  double delay = 0.0;      // [s]
  double friction = 0.0;   // [1] dry friction as a fraction of the full force
  double residual = 0.0;   // [1] RMS of the residuals divided by the RMS of the motion
};

// Throws std::invalid_argument with one sentence if there are fewer than 20 samples or no motion.
PulseFit fit_pulses(std::span<const Pulse> pulses);

// The gain of one more pulse of the lever that `known` describes. Throws as fit_pulses() does.
double gain_of(const Pulse& pulse, const PulseFit& known);

}  // namespace gearshift::haptics
