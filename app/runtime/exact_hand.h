// A hand that receives a target in every cycle and follows it exactly, including the velocity.
#pragma once

#include "haptics/device/hand.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::runtime {

class ExactHand final : public haptics::HandDriver {
 public:
  // `target` must outlive this object and must have no other reader.
  explicit ExactHand(haptics::LatestValue<haptics::HandTarget>& target) noexcept : target_(target) {}

  haptics::HandTarget next(double, glm::dvec2) noexcept override {
    target_.update();
    return target_.value();
  }

 private:
  haptics::LatestValue<haptics::HandTarget>& target_;
};

}  // namespace gearshift::runtime
