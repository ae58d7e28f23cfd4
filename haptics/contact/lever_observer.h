// Estimates position, velocity and the hand's force from position samples and motor forces, predicted to the moment
// when the next command takes effect. Used for contact on devices with delay.
//
// This work is based on:
// D. G. Luenberger. An Introduction to Observers. 1971
// J. Ackermann. Der Entwurf linearer Regelungssysteme im Zustandsraum. 1972
//
// Each axis is modelled as m x'' + b x' + k x = u + w, with the known motor force u and the hand's force w, assumed
// constant. All three poles of the estimation error are at exp(-bandwidth T).
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

// Decay rate of the estimation error [1/s]. Faster amplifies encoder quantisation; slower cannot track a heavy hand.
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

  // The estimate one period later, under the motor force `force` [N] and before the next sample is known.
  AxisEstimate predict(const AxisEstimate& estimate, double force) const noexcept;
  // The prediction, corrected by the position sample [m] of the predicted instant.
  AxisEstimate correct(AxisEstimate predicted, double position) const noexcept;
  // Displacement at the end of a period, per unit of force held during the period. [m/N]
  double compliance() const noexcept { return stepper_.step({}, 1.0).position; }

 private:
  AxisStepper stepper_;
  std::array<double, 3> gain_{};  // correction of position, velocity and hand force per metre of prediction error
};

// Predicted motion over the period in which the next command acts.
struct ObservedMotion {
  glm::dvec2 position{0.0};    // [m] position at the beginning of that period
  glm::dvec2 end{0.0};         // [m] position at its end, without motor force; the loop adds other forces' effect
  glm::dvec2 compliance{0.0};  // [m/N] displacement of `end` per unit of held force, per axis
};

class LeverObserver {
 public:
  LeverObserver(const DeviceSpec& spec, double period) noexcept;  // period [s]

  // commanded: the force written in the previous cycle [N]; skipped: cycles missed since then, over which that force
  // was held. Real-time safe.
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
  int blind_cycles_ = 0;  // [cycles] time since the last fresh sample
};

}  // namespace gearshift::haptics
