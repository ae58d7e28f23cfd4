// How large the panel is drawn. In steps: each scale has fonts of its own, and a window's edge that is dragged would make
// them anew frame by frame.
#pragma once

#include <algorithm>
#include <cmath>

namespace gearshift {

class UiScale {
 public:
  // Of a window of that height [px] on a display of that scale [1]. A minimised one, of height 0, keeps what was.
  float follow(int height, float content_scale) {
    constexpr float kLines = 1080.0f;  // [px] a picture of this height has the panel at scale 1
    constexpr float kSteps = 4.0f;     // a unit
    if (height > 0) scale_ = std::max(content_scale, std::floor(kSteps * static_cast<float>(height) / kLines) / kSteps);
    return scale_;
  }

  // In a headset, where what the panel's columns leave hangs as wide as ever: without them it has twice the pixels, and its
  // text is as large. width [px]: of the panel's picture.
  static float in_headset(int width, bool columns) { return static_cast<float>(width) / (columns ? 1280.0f : 640.0f); }

 private:
  float scale_ = 1.0f;
};

}  // namespace gearshift
