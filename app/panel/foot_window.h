// A part of the panel that stands at the foot of the cabin, in its middle: the lesson's card, the replay's bar.
#pragma once

#include <imgui.h>

#include "app/panel/controls.h"

namespace gearshift {

inline constexpr float kFootMargin = 0.8f;  // [em] beside it, and half of it below

// [px] as wide as it may be, at most so many em; less than kLeastFootWidth em: no word has room.
float foot_width(const ControlRect& room, float most);
inline constexpr float kLeastFootWidth = 10.0f;  // [em]

// Its size is asked for before. As ImGui::Begin: ends with ImGui::End() in any case.
bool begin_at_foot(const char* name, const ControlRect& room, ImGuiWindowFlags more);

}  // namespace gearshift
