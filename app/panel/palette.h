// One colour for one meaning, in all views of the panel.
#pragma once

#include "engine/ui/ui_style.h"

namespace gearshift::ink {

inline constexpr ImU32 kHand = IM_COL32(104, 178, 240, 255);      // f_h
inline constexpr ImU32 kActuator = IM_COL32(242, 153, 74, 255);   // f_a, and what is commanded
inline constexpr ImU32 kJoystick = IM_COL32(176, 148, 230, 255);  // f_j
inline constexpr ImU32 kLever = IM_COL32(232, 236, 241, 255);     // measured
inline constexpr ImU32 kProxy = IM_COL32(94, 200, 168, 255);      // drawn
inline constexpr ImU32 kPlate = IM_COL32(38, 45, 54, 255);
inline constexpr ImU32 kFree = IM_COL32(11, 13, 17, 255);
inline constexpr ImU32 kWall = IM_COL32(148, 160, 174, 255);
inline constexpr ImU32 kBuffer = IM_COL32(238, 170, 66, 46);

}  // namespace gearshift::ink
