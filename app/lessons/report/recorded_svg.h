// Draws a recorded shift.
#pragma once

#include <string>

#include "app/lessons/report/shift_recording.h"

namespace gearshift::lessons {

// Charts over time: hand force, engine and gearbox shaft speeds (only with a car), pedals, gear.
std::string force_svg(const ShiftRecording& shift);
std::string path_svg(const ShiftRecording& shift);  // paths of hand and displayed lever, and the shortest path

}  // namespace gearshift::lessons
