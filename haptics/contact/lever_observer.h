// Estimates the lever's position and velocity and the hand's force from position samples and motor forces. The estimate
// is predicted to the moment when the next command takes effect. Used for wall contact on devices with delay.
//
// This work is based on:
// D. G. Luenberger. An Introduction to Observers. 1971
// J. Ackermann. Der Entwurf linearer Regelungssysteme im Zustandsraum. 1972
//
// Model of each axis: m x'' + b x' + k x = u + w, with mass m, damping b, stiffness k, known motor force u and hand
// force w. The hand force is assumed constant. All three poles of the estimation error are at exp(-bandwidth T) from
// sample to sample, with the samples' interval T.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/device/haptic_device.h"
#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

// Decay rate [1/s] of the observer's estimation error. A higher rate amplifies encoder quantisation; a lower rate
// cannot track a heavy hand. `interval`: between samples [s]
inline double observer_bandwidth(double interval) noexcept {
  return std::min(900.0, 2.5 / interval);
}

struct AxisEstimate {
  double position = 0.0;  // [m]
  double velocity = 0.0;  // [m/s]
  double hand = 0.0;      // [N]
};

// Correction of position, velocity and hand force per metre of prediction error.
using ObserverGain = std::array<double, 3>;
ObserverGain observer_gain(const AxisModel& axis, double bandwidth, double interval) noexcept;  // [1/s], [s]

class AxisObserver {
 public:
  AxisObserver(const AxisModel& axis, double period) noexcept : stepper_(axis, period) {}  // period [s]

  // Predicts the estimate one period ahead, under the motor force `force` [N].
  AxisEstimate predict(const AxisEstimate& estimate, double force) const noexcept;
  // Corrects a predicted estimate with the position sample [m] of the predicted instant.
  static AxisEstimate correct(const AxisEstimate& predicted, const ObserverGain& gain, double position) noexcept;
  // Displacement [m/N] at the end of a period, per newton of force held during the period.
  double compliance() const noexcept { return stepper_.step({}, 1.0).position; }

 private:
  AxisStepper stepper_;
};

// Predicted motion during the period in which the next command acts.
struct ObservedMotion {
  glm::dvec2 position{0.0};    // [m] position when the next command takes effect
  glm::dvec2 end{0.0};         // [m] position one period later, without any motor force
  glm::dvec2 compliance{0.0};  // [m/N] per axis, displacement of `end` per newton of held force
};

class LeverObserver {
 public:
  LeverObserver(const DeviceSpec& spec, double period) noexcept;  // period [s]

  // `commanded`: force written in the previous cycle [N]. `skipped`: number of cycles missed since then, during which
  // the device held that force. Real-time safe.
  ObservedMotion update(const LeverMotion& motion, glm::dvec2 commanded, std::int64_t skipped = 0) noexcept;

 private:
  static constexpr std::size_t kMaxInterval = 10;  // [cycles] between samples

  struct Axis {
    Axis(const AxisModel& model, double period) noexcept;

    AxisObserver observer;
    std::array<ObserverGain, kMaxInterval> gain;  // for samples every 1, 2, ... cycles
    AxisEstimate estimate;
  };

  double command_before(std::size_t age, int axis) const noexcept;
  void advance_period(glm::dvec2 commanded) noexcept;
  void track_interval(bool is_fresh, std::int64_t skipped) noexcept;
  AxisEstimate estimate_at_effect(Axis& axis, int index, const LeverMotion& motion) noexcept;

  std::array<Axis, 2> axis_;
  std::array<glm::dvec2, kMaxLoopDelay + 1> commands_{};  // [N] ring buffer of the last commands
  std::size_t newest_ = 0;                                // index of the newest command
  std::size_t spec_delay_;      // [cycles] of the device, the wait for its next sample included
  std::size_t delay_;           // [cycles] from a command to its effect
  std::size_t interval_ = 1;    // [cycles] between samples
  double mean_interval_ = 0.0;  // [cycles] 0: not yet known
  bool started_ = false;
  int blind_cycles_ = 0;  // [cycles] since the last fresh sample
};

}  // namespace gearshift::haptics
