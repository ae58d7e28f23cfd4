// What a lever is and how late it answers, from short pulses of force: the exact response of a mass with damping and a
// spring, fitted by least squares.
//
//   x'' + damping x' + stiffness x = gain u(t - delay),   u = magnitude for the length of the pulse, then 0
//
// The gain, and where each pulse began, follow in closed form from the other three (variable projection), which
// Levenberg's and Marquardt's method finds.
//
// This work is based on:
// Gene Golub, Victor Pereyra. The Differentiation of Pseudo-Inverses and Nonlinear Least Squares Problems Whose Variables
// Separate. 1973
// Donald Marquardt. An Algorithm for Least-Squares Estimation of Nonlinear Parameters. 1963
#pragma once

#include <span>
#include <vector>

namespace gearshift {

struct PulseSample {
  double time = 0.0;      // [s] since the pulse was sent
  double position = 0.0;  // from rest, in any unit of length
};

struct Pulse {
  double magnitude = 0.0;  // [1] -1 to 1, of the full force
  double length = 0.0;     // [s] from the pulse to its end, as both were sent
  std::vector<PulseSample> samples;
};

struct PulseFit {
  double gain = 0.0;       // [length/s^2] acceleration at magnitude 1
  double damping = 0.0;    // [1/s] b / m
  double stiffness = 0.0;  // [1/s^2] k / m
  double delay = 0.0;      // [s]
  double residual = 0.0;   // [1] root mean square of what is left, over that of the motion
};

// Throws std::invalid_argument in one sentence: fewer than 20 samples, or no motion in them.
PulseFit fit_pulses(std::span<const Pulse> pulses);

}  // namespace gearshift
