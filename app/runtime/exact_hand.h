// A hand that gets a target for every cycle and takes it over exactly, including the velocity.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::runtime {

class ExactHand final : public haptics::HandDriver {
 public:
  // The channel must outlive this object, which is its only reader.
  explicit ExactHand(haptics::LatestValue<haptics::HandTarget>& channel) noexcept : channel_(channel) {}

  haptics::HandTarget next(double, glm::dvec2) noexcept override {
    channel_.update();
    return channel_.value();
  }

 private:
  haptics::LatestValue<haptics::HandTarget>& channel_;
};

}  // namespace gearshift::runtime
