// Simulated user of an emulated stick, who moves the lever to a target or does not touch it.
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

  std::function<glm::dvec2()> target_position;  // [m] target of the hand; if empty, the hand does not touch the lever

 private:
  glm::dvec2 lever_{0.0};
};

}  // namespace gearshift::test
