// A hand that moves in a straight line to a given point, and stays there.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/device/hand.h"

namespace gearshift::test {

class GoToHand final : public haptics::HandDriver {
 public:
  explicit GoToHand(double period) : period_(period) {}  // [s] interval between calls of next()

  void go(glm::dvec2 to) noexcept { to_ = to; }  // [m]

  // Moves the target towards the point set by go(). The handle's spring pulls the lever back, so the push grows until
  // the lever has reached the target.
  haptics::HandTarget next(double, glm::dvec2 lever) noexcept override {
    const glm::dvec2 distance = to_ - target_.position;
    const double step = kSpeed * period_, left = glm::length(distance);
    target_.position = left <= step ? to_ : target_.position + step / left * distance;
    target_.push += kEffort * period_ * (target_.position - lever);
    target_.push = glm::clamp(target_.push, -kMaxPush, kMaxPush);
    return target_;
  }

 private:
  static constexpr double kSpeed = 0.2;      // [m/s]
  static constexpr double kEffort = 2000.0;  // [N/(m s)]
  static constexpr double kMaxPush = 4.0;    // [N]

  double period_;
  glm::dvec2 to_{0.0};
  haptics::HandTarget target_;
};

}  // namespace gearshift::test
