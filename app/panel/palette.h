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
inline constexpr ImU32 kEngine = IM_COL32(240, 214, 110, 255);  // its speed
inline constexpr ImU32 kShaft = IM_COL32(176, 188, 202, 255);   // the gearbox's input, its speed
inline constexpr ImU32 kIdeal = IM_COL32(170, 222, 92, 255);    // the shortest way of a shift
inline constexpr ImU32 kDriven = IM_COL32(240, 122, 184, 255);  // the way that it took
inline constexpr ImU32 kBiteZone = IM_COL32(240, 190, 80, 90);  // where a clutch takes hold, over its pedal
inline constexpr ImU32 kPrimary = IM_COL32(46, 120, 166, 255);  // the button that goes on

}  // namespace gearshift::ink
