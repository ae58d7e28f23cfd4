#include "tests/support/usb/touring_hand.h"

#include <algorithm>
#include <vector>

#include "haptics/loop/shift_script.h"

namespace gearshift::test {
namespace {

haptics::ScriptedHand tour_of(const haptics::Gate& gate, double period) {
  const glm::dvec2 start = haptics::rest_position(gate, haptics::kNeutralGear);
  const std::vector<int> gears = haptics::tour_order(gate);
  return {haptics::touring_hand(start), haptics::shift_strokes(gate, start, gears), period};
}

}  // namespace

TouringHand::TouringHand(const haptics::Gate& gate, double period) : script_(tour_of(gate, period)), period_(period) {
  target_.position = haptics::rest_position(gate, haptics::kNeutralGear);
}

haptics::HandTarget TouringHand::next(double, glm::dvec2 lever) noexcept {
  if (works_) {
    time_ += period_;
    target_ = script_.next(std::max(time_, 0.0), lever);
  } else {
    target_.velocity = target_.push = glm::dvec2(0.0);
  }
  return target_;
}

}  // namespace gearshift::test
