// Notices a stick whose forces act in the other direction than calibrated, from the motion that follows a force.
//
// The handle moves by m a + b v + k x = u + h, with u the force that the stick is believed to make and h the hand's
// unknown force. Where u changes faster than a hand can, the left side follows u: by m / (m + hand's mass), and never
// against it. So both sides are filtered alike to what is fast, and compared over the last half second: a reversed force
// has a negative correlation, and a slope of about -m / (m + hand's mass). A hand that presses into a wall may give the one
// but not the other. Samples at the stops are ignored. A missing force cannot be noticed.
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift::haptics {

class ForceWatch {
 public:
  // `lag` [s]: typical time from a force to the reading that shows it; `interval` [s]: typical time between readings
  ForceWatch(const DeviceSpec& spec, double lag, double interval) noexcept;

  // Call it with each new reading: `position` [m], `force` [N] as believed, `seconds` since the last reading. Real-time
  // safe.
  void update(glm::dvec2 position, glm::dvec2 force, double seconds) noexcept;
  void reset() noexcept;  // when the motors were off

  bool is_reversed() const noexcept;
  // 0 while the force has not changed enough.
  double correlation(int axis) const noexcept;  // [1] -1 to 1
  double slope(int axis) const noexcept;        // [1] left side over u

 private:
  // Second-order low pass: its states are the smoothed value and its first two derivatives.
  struct Smooth {
    double value = 0.0, rate = 0.0, acceleration = 0.0;
    void update(double input, double frequency, double seconds) noexcept;
  };
  struct Axis {
    AxisModel handle;
    double reach = 0.0;  // [m]
    Smooth position, force;
    std::array<double, kMaxLoopDelay + 1> delayed{};  // [N] forces of the last readings
    double slow_motion = 0.0, slow_force = 0.0;       // [N] low-passed, to be subtracted
    // [N^2 s] averages of the fast parts: u u, the left side squared, and their product
    double force_power = 0.0, motion_power = 0.0, product = 0.0;
    double reversed_time = 0.0;  // [s] for which it looks reversed
  };

  void update(Axis& axis, double position, double force, double seconds) noexcept;
  static bool looks_reversed(const Axis& axis) noexcept;

  double smoothing_;  // [rad/s] corner frequency of the low pass
  std::size_t delay_, at_ = 0;
  bool has_started_ = false;
  std::array<Axis, 2> axis_;
};

}  // namespace gearshift::haptics
