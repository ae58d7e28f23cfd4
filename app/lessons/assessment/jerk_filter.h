// Jerk as a passenger feels it: the rate of change of the car's acceleration after a low-pass filter.
#pragma once

namespace gearshift::lessons {

inline constexpr double kJerkCutoff = 15.0;  // [Hz] middle of the 10 to 20 Hz used for shift comfort
// Peak jerk after a step of 1 m/s^2, w exp(-pi / 4), w = 2 pi kJerkCutoff; reached 12 ms after the step. [1/s]
inline constexpr double kJerkPerStep = 6.283185307179586 * kJerkCutoff * 0.45593812776599624;
inline constexpr double kJerkSettlingTime = 0.1;  // [s] the response to a step has then decayed to 0.1 %

// Second-order Butterworth low-pass y'' + 2 s y' + w^2 (y - u) = 0, s = w / sqrt(2), solved exactly over each period
// with the input u held constant. This hold is the only way in which the result depends on the period.
class JerkFilter {
 public:
  // acceleration [m/s^2], dt [s] since the last call. Returns y' [m/s^3]. The first call initialises the filter; values
  // that are not finite are skipped.
  double update(double acceleration, double dt) noexcept;
  double jerk() const noexcept { return rate_; }

 private:
  bool filled_ = false;
  double level_ = 0.0;  // [m/s^2] y
  double rate_ = 0.0;   // [m/s^3] y'
};

}  // namespace gearshift::lessons
