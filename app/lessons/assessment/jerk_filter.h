// Jerk as a passenger feels it: the rate of change of the car's acceleration after a low-pass filter.
#pragma once

namespace gearshift::lessons {

inline constexpr double kJerkCutoff = 15.0;  // [Hz] middle of the 10 to 20 Hz range used to assess shift comfort
// [1/s] Peak jerk after a step of 1 m/s^2: w exp(-pi / 4), with w = 2 pi kJerkCutoff. The peak comes 12 ms after the
// step.
inline constexpr double kJerkPerStep = 6.283185307179586 * kJerkCutoff * 0.45593812776599624;
inline constexpr double kMaxBrakeForJerk = 0.05;  // [1] brake pedal position above which jerk is not counted
inline constexpr double kJerkSettlingTime = 0.1;  // [s] a step response is within 0.2 % of its end

// Second-order Butterworth low-pass with input u and output y: y'' + 2 s y' + w^2 (y - u) = 0, with cutoff w = 2 pi
// kJerkCutoff and s = w / sqrt(2). Each period is solved exactly for a constant input, so holding the input constant is
// the only approximation.
class JerkFilter {
 public:
  // `acceleration` [m/s^2]. `dt` [s]: time since the last call. Returns the filtered jerk [m/s^3]. The first call
  // initialises the filter. Values that are not finite are skipped.
  double update(double acceleration, double dt) noexcept;
  double jerk() const noexcept { return rate_; }

 private:
  bool filled_ = false;
  double level_ = 0.0;  // [m/s^2] y
  double rate_ = 0.0;   // [m/s^3] y'
};

}  // namespace gearshift::lessons
