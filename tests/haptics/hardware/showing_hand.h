// A person in front of an emulated stick: shows it what the calibrator asks for, or keeps the hands off.
#pragma once

#include <functional>

#include "haptics/device/hand.h"

namespace gearshift {

class ShowingHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2 lever) noexcept override {
    constexpr double kPeriod = 0.001;  // [s]
    HandTarget target;
    const glm::dvec2 velocity = (lever - lever_) / kPeriod;
    lever_ = lever;
    if (wants) target.push = 400.0 * (wants() - lever) - 10.0 * velocity;
    return target;
  }

  std::function<glm::dvec2()> wants;  // [m] where the lever shall be; nothing: hands off

 private:
  glm::dvec2 lever_{0.0};
};

}  // namespace gearshift
