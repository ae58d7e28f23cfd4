// A hand that points at the panel is its mouse, until the one on the desk moves.
#pragma once

#include <optional>

#include "app/train/panel_pointer.h"
#include "app/train/worn_headset.h"
#include "engine/window/window.h"

namespace gearshift {

class PointingHand {
 public:
  // Once a frame, of that many seconds. hand: at something of the panel; size [px]: of its picture; desk_leads_lever: the
  // desk's mouse moves the lever and not the panel.
  void follow(const WindowInput& desk, bool desk_leads_lever, const std::optional<WornHeadset::Pointer>& hand,
              glm::ivec2 size, double seconds) {
    const bool came = hand.has_value() && !was_there_;
    was_there_ = hand.has_value();
    // Who comes with the trigger pulled has not pulled it here.
    holds_ = hand && hand->selects && (holds_ || (!came && !pulled_before_));
    pulled_before_ = hand && hand->selects;
    const bool desk_moves = !desk_leads_lever && (desk.mouse_moved != glm::dvec2(0.0) || desk.mouse_down[0]);
    leads_ = hand.has_value() && (came || holds_ || (leads_ && !desk_moves));
    pointer_.reset();
    if (leads_) pointer_ = PanelPointer{hand->hit.at * glm::dvec2(size), holds_, kScroll * seconds * hand->scroll};
  }

  const std::optional<PanelPointer>& pointer() const noexcept { return pointer_; }  // none: the desk's mouse

 private:
  static constexpr double kScroll = 12.0;  // [lines/s] the stick at its end
  std::optional<PanelPointer> pointer_;
  bool was_there_ = false, pulled_before_ = false, holds_ = false, leads_ = false;
};

}  // namespace gearshift
