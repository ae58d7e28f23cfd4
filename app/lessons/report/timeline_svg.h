// Draws shifts as bars on a common time axis: how long the clutch was down and when the lever moved.
#pragma once

#include <span>
#include <string>

#include "app/lessons/report/report_page.h"

namespace gearshift::lessons {

// Requires at least one shift. If the clutch was pressed more than once, the times of the presses come from the
// recording. If there is no recording then, the clutch bar is pale, and lever movement without the clutch is not
// marked.
std::string timeline_svg(std::span<const ShownShift> shifts);

}  // namespace gearshift::lessons
