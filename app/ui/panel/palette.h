// Each colour has one meaning in all views of the panel. palette_test.cpp keeps texts legible, and meanings apart for
// people who do not see all colours.
#pragma once

#include "engine/ui/ui_style.h"

namespace gearshift::ui::ink {

using namespace engine::ink;  // colours that all windows share

inline constexpr ImU32 kHand = IM_COL32(104, 178, 240, 255);      // f_h
inline constexpr ImU32 kActuator = IM_COL32(242, 153, 74, 255);   // delivered force (f_a) and commanded force
inline constexpr ImU32 kJoystick = IM_COL32(244, 211, 255, 255);  // f_j
inline constexpr ImU32 kLever = IM_COL32(232, 236, 241, 255);     // lever point
inline constexpr ImU32 kProxy = IM_COL32(94, 200, 168, 255);      // proxy
inline constexpr ImU32 kPlate = IM_COL32(38, 45, 54, 255);
inline constexpr ImU32 kFree = IM_COL32(11, 13, 17, 255);
inline constexpr ImU32 kWall = IM_COL32(148, 160, 174, 255);
inline constexpr ImU32 kBuffer = IM_COL32(238, 170, 66, 46);
inline constexpr ImU32 kEngine = IM_COL32(240, 214, 110, 255);    // engine speed
inline constexpr ImU32 kShaft = IM_COL32(176, 188, 202, 255);     // speed of the gearbox input shaft
inline constexpr ImU32 kIdeal = IM_COL32(170, 222, 92, 255);      // shortest path of a shift
inline constexpr ImU32 kDriven = IM_COL32(215, 95, 150, 255);     // driven path of a shift
inline constexpr ImU32 kBiteMark = IM_COL32(255, 214, 110, 255);  // its outline, while the learner gets help
inline constexpr ImU32 kBiteZone = IM_COL32(240, 190, 80, 90);    // bite zone, drawn over the clutch pedal's bar
inline constexpr ImU32 kPrimary = IM_COL32(38, 106, 150, 255);    // the primary button

}  // namespace gearshift::ui::ink
