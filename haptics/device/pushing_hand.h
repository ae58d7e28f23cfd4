// A simulated hand for tests. It pushes with a force that is given as a function of time.
#pragma once

#include <functional>
#include <utility>

#include "haptics/device/hand.h"

namespace gearshift::haptics {

class PushingHand final : public HandDriver {
 public:
  explicit PushingHand(std::function<glm::dvec2(double time, glm::dvec2 lever)> push) : push_(std::move(push)) {}
  HandTarget next(double time, glm::dvec2 lever) noexcept override {
    HandTarget target;
    target.position = lever;
    target.push = push_(time, lever);
    return target;
  }

 private:
  std::function<glm::dvec2(double, glm::dvec2)> push_;
};

}  // namespace gearshift::haptics
