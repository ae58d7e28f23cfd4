// Scale of the panel. The scale changes only in steps. Each scale needs its own fonts, and with a continuous scale the
// fonts would be rebuilt in every frame while the user drags the window's edge.
#pragma once

#include <algorithm>
#include <cmath>

namespace gearshift::session {

class UiScale {
 public:
  // Scale for a window of this height [px] on a display with this content scale [1]. For a minimised window (height 0)
  // the scale does not change.
  float follow(int height, float content_scale) {
    constexpr float kLines = 1080.0f;  // [px] window height at scale 1
    constexpr float kSteps = 4.0f;     // number of steps per unit of scale
    if (height > 0) scale_ = std::max(content_scale, std::floor(kSteps * static_cast<float>(height) / kLines) / kSteps);
    return scale_;
  }

  // Scale in a headset, where the panel has a fixed width. Without its side columns the panel is shown at half that
  // width, so the scale is doubled to keep the size of the text. `width` [px]: width of the panel's picture.
  static float in_headset(int width, bool columns) { return static_cast<float>(width) / (columns ? 1280.0f : 640.0f); }

 private:
  float scale_ = 1.0f;
};

}  // namespace gearshift::session
