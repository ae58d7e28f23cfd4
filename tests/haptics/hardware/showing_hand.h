// The user of an emulated stick, who moves the lever as the calibrator asks or does not touch it.
#pragma once

#include <functional>

#include "haptics/device/hand.h"

namespace gearshift::test {

class ShowingHand final : public haptics::HandDriver {
 public:
  haptics::HandTarget next(double, glm::dvec2 lever) noexcept override {
    constexpr double kPeriod = 0.001;  // [s]
    haptics::HandTarget target;
    const glm::dvec2 velocity = (lever - lever_) / kPeriod;
    lever_ = lever;
    if (target_position) target.push = 400.0 * (target_position() - lever) - 10.0 * velocity;
    return target;
  }

  std::function<glm::dvec2()> target_position;  // [m] target of the hand; empty: the lever is not touched

 private:
  glm::dvec2 lever_{0.0};
};

}  // namespace gearshift::test
