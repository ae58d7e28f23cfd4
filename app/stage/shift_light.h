// The shift light: two arrows above the gear display, one drawn at a time, none while there is nothing to advise.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace gearshift {

// Names of its nodes.
inline constexpr const char* kShiftUp = "ShiftUp";
inline constexpr const char* kShiftDown = "ShiftDown";

// Adds both arrows, lit, to a model that has the cluster's "GearPanel". Throws std::runtime_error where it has not.
void add_shift_light(Model& model);

}  // namespace gearshift
