// Draws shifts as bars on a common time axis: how long the clutch was down and when the lever moved.
#pragma once

#include <span>
#include <string>

#include "app/lessons/report/report_page.h"

namespace gearshift::lessons {

// Requires at least one shift. If the pedal went down more than once, its times come from the recording; without a
// recording the clutch bar is pale, and lever movement without the clutch is not marked.
std::string timeline_svg(std::span<const ShownShift> shifts);

}  // namespace gearshift::lessons
