// The jerk that a passenger feels: the rate of the car's acceleration behind a low-pass.
#pragma once

namespace gearshift {

inline constexpr double kJerkCutoff = 15.0;  // [Hz] the middle of the 10 to 20 Hz in use for shift comfort
// The most that a step of 1 m/s^2 gives, w exp(-pi / 4), a quarter of a period of the filter after it. [1/s]
inline constexpr double kJerkOfStep = 6.283185307179586 * kJerkCutoff * 0.45593812776599624;
inline constexpr double kJerkSettles = 0.1;  // [s] after which 0.1 % of a step is left of the filter's answer

// Second-order Butterworth low-pass y'' + 2 s y' + w^2 (y - u) = 0, s = w / sqrt(2), solved exactly over each period
// with the input held, so that the answer does not depend on the period but by that hold.
class JerkFilter {
 public:
  // acceleration [m/s^2], dt [s] since the last one. Returns y' [m/s^3]. The first call fills the filter; what is
  // no number is left out.
  double update(double acceleration, double dt) noexcept;
  double jerk() const noexcept { return rate_; }

 private:
  bool filled_ = false;
  double level_ = 0.0;  // [m/s^2] y
  double rate_ = 0.0;   // [m/s^3] y'
};

}  // namespace gearshift
