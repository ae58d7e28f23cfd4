// Estimates the lever's position and velocity and the hand's force from position samples and motor forces. The estimate
// is predicted to the moment when the next command takes effect. Used for wall contact on devices with delay.
//
// This work is based on:
// D. G. Luenberger. An Introduction to Observers. 1971
// J. Ackermann. Der Entwurf linearer Regelungssysteme im Zustandsraum. 1972
//
// Model of each axis: m x'' + b x' + k x = u + w, with mass m, damping b, stiffness k, known motor force u and hand
// force w. The hand force is assumed constant. All three poles of the estimation error are at exp(-bandwidth T), with
// period T.
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
// cannot track a heavy hand.
inline double observer_bandwidth(double period) noexcept {
  return std::min(500.0, 1.25 / period);
}

struct AxisEstimate {
  double position = 0.0;  // [m]
  double velocity = 0.0;  // [m/s]
  double hand = 0.0;      // [N]
};

class AxisObserver {
 public:
  AxisObserver(const AxisModel& axis, double bandwidth, double period) noexcept;  // bandwidth [1/s], period [s]

  // Predicts the estimate one period ahead, under the motor force `force` [N].
  AxisEstimate predict(const AxisEstimate& estimate, double force) const noexcept;
  // Corrects a predicted estimate with the position sample [m] of the predicted instant.
  AxisEstimate correct(AxisEstimate predicted, double position) const noexcept;
  // Displacement [m/N] at the end of a period, per newton of force held during the period.
  double compliance() const noexcept { return stepper_.step({}, 1.0).position; }

 private:
  AxisStepper stepper_;
  std::array<double, 3> gain_{};  // correction of position, velocity and hand force per metre of prediction error
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
  struct Axis {
    AxisObserver observer;
    AxisEstimate estimate;
  };

  double command_before(std::size_t age, int axis) const noexcept;
  void advance_period(glm::dvec2 commanded) noexcept;
  AxisEstimate estimate_at_effect(Axis& axis, int index, const LeverMotion& motion) noexcept;

  std::array<Axis, 2> axis_;
  std::array<glm::dvec2, kMaxLoopDelay + 1> commands_{};  // [N] ring buffer of the last commands
  std::size_t newest_ = 0;                                // index of the newest command
  std::size_t delay_;
  bool started_ = false;
  int blind_cycles_ = 0;  // [cycles] since the last fresh sample
};

}  // namespace gearshift::haptics
