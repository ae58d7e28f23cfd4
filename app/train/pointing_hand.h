// A hand that points at the panel is its mouse, until the instructor moves the desktop's.
#pragma once

#include <optional>

#include "app/train/worn_headset.h"
#include "engine/window/window.h"

namespace gearshift {

class PointingHand {
 public:
  // Once a frame. size [px]: of the panel's picture.
  void follow(const WindowInput& window, const std::optional<WornHeadset::Pointer>& hand, glm::ivec2 size) {
    input_ = window;
    const bool came = hand.has_value() && !was_there_, clicked = hand && hand->selects;
    was_there_ = hand.has_value();
    const bool moved = window.mouse_moved != glm::dvec2(0.0) || window.mouse_down[0];
    if (came || clicked) leads_ = true;
    if (!hand || (moved && !clicked)) leads_ = false;
    if (!leads_) return;
    input_.mouse = hand->hit.at * glm::dvec2(size);
    input_.mouse_moved = glm::dvec2(0.0);
    input_.mouse_down = {hand->selects};
    input_.scroll += kScroll * hand->scroll;
  }

  const WindowInput& input() const noexcept { return input_; }
  bool leads() const noexcept { return leads_; }

 private:
  static constexpr double kScroll = 0.2;  // [lines] a frame, the stick at its end
  WindowInput input_;
  bool was_there_ = false, leads_ = false;
};

}  // namespace gearshift
