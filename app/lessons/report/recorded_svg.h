// Draws a recorded shift.
#pragma once

#include <string>

#include "app/lessons/report/shift_recording.h"

namespace gearshift::lessons {

// Charts over time: hand force; with a car, engine and gearbox shaft speed; pedals; gear.
std::string force_svg(const ShiftRecording& shift);
std::string path_svg(const ShiftRecording& shift);  // paths of hand, displayed lever and the shortest path in the gate

}  // namespace gearshift::lessons
