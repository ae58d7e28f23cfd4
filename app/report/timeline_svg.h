// Shifts as bars on one time axis: how long the clutch was down, when the lever went.
#pragma once

#include <span>
#include <string>

#include "app/report/chosen_shifts.h"

namespace gearshift {

std::string timeline_svg(std::span<const ChosenShift> shifts);  // at least one

}  // namespace gearshift
