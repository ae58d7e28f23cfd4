// A hand whose owner knows every cycle where it is: passed on as it is given, velocity included.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/rt/latest_value.h"

namespace gearshift {

class GivenHand final : public HandDriver {
 public:
  // The channel must outlive the hand, which is its only reader.
  explicit GivenHand(LatestValue<HandTarget>& channel) noexcept : channel_(channel) {}

  HandTarget next(double, glm::dvec2) noexcept override {
    channel_.update();
    return channel_.value();
  }

 private:
  LatestValue<HandTarget>& channel_;
};

}  // namespace gearshift
