// Lets a tracked hand act as the panel's mouse, until the desktop mouse moves.
#pragma once

#include <optional>

#include "app/session/learner_headset.h"
#include "app/session/panel_pointer.h"
#include "engine/window/window.h"

namespace gearshift::session {

class PointingHand {
 public:
  // Call once per frame. `desk_leads_lever`: true if the desktop mouse moves the lever, not the panel's cursor. `hand`:
  // where the hand points at the panel. `size` [px]: size of the panel's picture. `seconds`: duration of the frame.
  void follow(const engine::WindowInput& desk, bool desk_leads_lever,
              const std::optional<LearnerHeadset::Pointer>& hand, glm::ivec2 size, double seconds) {
    const bool has_arrived = hand.has_value() && !was_present_;
    was_present_ = hand.has_value();
    // If the trigger was already pulled when the hand reached the panel, it does not click.
    is_pressed_ = hand && hand->selects && (is_pressed_ || (!has_arrived && !pulled_before_));
    pulled_before_ = hand && hand->selects;
    const bool desk_moves = !desk_leads_lever && (desk.mouse_moved != glm::dvec2(0.0) || desk.mouse_down[0]);
    is_active_ = hand.has_value() && (has_arrived || is_pressed_ || (is_active_ && !desk_moves));
    pointer_.reset();
    if (is_active_)
      pointer_ = PanelPointer{hand->hit.at * glm::dvec2(size), is_pressed_, kScroll * seconds * hand->scroll};
  }

  // The hand's pointer; empty while the desktop mouse controls the panel.
  const std::optional<PanelPointer>& pointer() const noexcept { return pointer_; }

 private:
  static constexpr double kScroll = 12.0;  // [lines/s] at full deflection of the thumbstick
  std::optional<PanelPointer> pointer_;
  bool was_present_ = false, pulled_before_ = false, is_pressed_ = false, is_active_ = false;
};

}  // namespace gearshift::session
