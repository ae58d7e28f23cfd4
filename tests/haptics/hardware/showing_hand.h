// A person in front of an emulated stick, who moves the lever as the calibrator asks or keeps the hands off.
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
    if (wants) target.push = 400.0 * (wants() - lever) - 10.0 * velocity;
    return target;
  }

  std::function<glm::dvec2()> wants;  // [m] target of the hand; empty: hands off

 private:
  glm::dvec2 lever_{0.0};
};

}  // namespace gearshift::test
