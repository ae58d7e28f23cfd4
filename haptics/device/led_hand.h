// A person leads the simulated hand: by mouse, stick or tracked controller.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/joystick/plant.h"
#include "haptics/rt/latest_value.h"

namespace gearshift {

// Follows the newest HandTarget's position through a critically damped filter: input that comes at the frame
// rate is a staircase at the haptic rate, and a stiff hand would rattle along its steps. The target's own
// velocity is not used: the filter has the true velocity of what it leads to.
// A target that is not finite is ignored.
class LedHand final : public HandDriver {
 public:
  // period: the device's [s], 1e-6 to 1. smoothing: time constant of the filter [s], 0.001 to 1. The channel
  // must outlive the hand; the hand is its only reader. Throws std::invalid_argument.
  LedHand(LatestValue<HandTarget>& channel, double period, double smoothing = 0.015);

  HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  LatestValue<HandTarget>& channel_;
  AxisModel filter_;
  AxisStepper stepper_;
  AxisState select_, shift_;
  HandTarget wanted_;
  bool holds_ = false;  // has taken hold of the lever, where it was
};

}  // namespace gearshift
