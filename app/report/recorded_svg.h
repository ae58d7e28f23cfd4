// A recorded shift as drawings.
#pragma once

#include <string>

#include "app/report/shift_recording.h"

namespace gearshift {

std::string force_svg(const RecordedShift& shift);  // the hand's force against time, the pedals below
std::string path_svg(const RecordedShift& shift);   // hand and drawn lever in the gate

}  // namespace gearshift
