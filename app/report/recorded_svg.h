// A recorded shift as drawings.
#pragma once

#include <string>

#include "app/report/shift_recording.h"

namespace gearshift {

// Against time: the hand's force, where there is a car engine and gearbox shaft below it, the pedals and the gear.
std::string force_svg(const ShiftRecording& shift);
std::string path_svg(const ShiftRecording& shift);  // hand and drawn lever in the gate, the shortest way over them

}  // namespace gearshift
