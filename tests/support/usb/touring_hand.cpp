#include "tests/support/usb/touring_hand.h"

#include <algorithm>
#include <vector>

#include "haptics/loop/shift_script.h"

namespace gearshift {
namespace {

ScriptedHand tour_of(const Gate& gate, double period) {
  const glm::dvec2 start = rest_position(gate, kNeutralGear);
  const std::vector<int> gears = tour_order(gate);
  return {touring_hand(start), shift_strokes(gate, start, gears), period};
}

}  // namespace

TouringHand::TouringHand(const Gate& gate, double period) : script_(tour_of(gate, period)), period_(period) {
  target_.position = rest_position(gate, kNeutralGear);
}

HandTarget TouringHand::next(double, glm::dvec2 lever) noexcept {
  if (works_) {
    time_ += period_;
    target_ = script_.next(std::max(time_, 0.0), lever);
  } else {
    target_.velocity = target_.push = glm::dvec2(0.0);
  }
  return target_;
}

}  // namespace gearshift
