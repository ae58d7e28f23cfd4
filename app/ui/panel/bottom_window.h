// A window centred at the bottom of the cabin view: the lesson card or the replay bar.
#pragma once

#include <imgui.h>

#include "app/ui/panel/controls.h"

namespace gearshift::ui {

inline constexpr float kBottomMargin = 0.8f;  // [em] margin on each side of the window; below it, half of this

// [px] Width available in `room` without the margins, at most `max` [em]. Below kMinBottomWidth, no text fits.
float bottom_width(const ControlRect& room, float max);
inline constexpr float kMinBottomWidth = 10.0f;  // [em]

// Set the window's size before the call. As after ImGui::Begin(), always call ImGui::End().
bool begin_at_bottom(const char* name, const ControlRect& room, ImGuiWindowFlags more);

}  // namespace gearshift::ui
