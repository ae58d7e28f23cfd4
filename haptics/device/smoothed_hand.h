// A simulated hand that the user leads with the mouse, a stick or a tracked controller.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/joystick/plant.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::haptics {

// Follows the position of the newest HandTarget through a critically damped filter: input at the frame rate is a
// staircase at the haptic rate, on which a stiff hand would rattle. The target's own velocity is ignored; the filter
// provides the velocity that matches its position. A target that is not finite is ignored.
class SmoothedHand final : public HandDriver {
 public:
  // period: the device's period [s], 1e-6 to 1. smoothing: time constant of the filter [s], 0.001 to 1. The channel
  // must outlive the hand, which must be its only reader. Throws std::invalid_argument.
  SmoothedHand(LatestValue<HandTarget>& channel, double period, double smoothing = 0.015);

  HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  LatestValue<HandTarget>& channel_;
  AxisModel filter_;
  AxisStepper stepper_;
  AxisState select_, shift_;
  HandTarget latest_;         // newest valid target
  bool has_started_ = false;  // the filter has been initialised at the lever's position
};

}  // namespace gearshift::haptics
