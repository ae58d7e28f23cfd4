// Shifts as bars on one time axis: how long the clutch was down, when the lever went.
#pragma once

#include <span>
#include <string>

#include "app/report/report_page.h"

namespace gearshift {

// At least one. Where the pedal went down more than once, its times are the recording's; without one the bar is hollow,
// and nothing is said of the lever without the clutch.
std::string timeline_svg(std::span<const ShownShift> shifts);

}  // namespace gearshift
