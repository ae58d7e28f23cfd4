// A simulated hand whose target the user moves with the mouse, a stick or a tracked controller.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/joystick/plant.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::haptics {

// Follows the position of the newest HandTarget through a critically damped filter. Without the filter, targets that
// arrive at the frame rate would be steps at the haptic rate, and a stiff hand would vibrate. Ignores the velocity in
// HandTarget: the filter computes a velocity that matches its position. A target that is not finite is ignored.
class SmoothedHand final : public HandDriver {
 public:
  // `period`: period of the device [s], 1e-6 to 1. `smoothing`: time constant of the filter [s], 0.001 to 1. `target`
  // must outlive the hand and must have no other reader. Throws std::invalid_argument.
  SmoothedHand(LatestValue<HandTarget>& target, double period, double smoothing = 0.015);

  HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  LatestValue<HandTarget>& target_;
  AxisModel filter_;
  AxisStepper stepper_;
  AxisState select_, shift_;
  HandTarget latest_;         // newest valid target
  bool has_started_ = false;  // the filter has started, at the lever's position
};

}  // namespace gearshift::haptics
