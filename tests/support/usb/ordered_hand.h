// A hand that goes where it is told, in a straight line, and stays there.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/device/hand.h"

namespace gearshift {

class OrderedHand final : public HandDriver {
 public:
  explicit OrderedHand(double period) : period_(period) {}  // [s] of the calls to next()

  void go(glm::dvec2 to) noexcept { to_ = to; }  // [m]

  // The handle's spring draws the lever back: the hand pushes until it is there.
  HandTarget next(double, glm::dvec2 lever) noexcept override {
    const glm::dvec2 way = to_ - target_.position;
    const double step = kSpeed * period_, left = glm::length(way);
    target_.position = left <= step ? to_ : target_.position + step / left * way;
    target_.push += kEffort * period_ * (target_.position - lever);
    target_.push = glm::clamp(target_.push, -kMostPush, kMostPush);
    return target_;
  }

 private:
  static constexpr double kSpeed = 0.2;      // [m/s]
  static constexpr double kEffort = 2000.0;  // [N/(m s)]
  static constexpr double kMostPush = 4.0;   // [N]

  double period_;
  glm::dvec2 to_{0.0};
  HandTarget target_;
};

}  // namespace gearshift
