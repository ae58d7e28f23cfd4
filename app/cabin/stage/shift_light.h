// The shift light: two arrows above the gear display, of which at most one is shown.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace gearshift::cabin {

// Node names.
inline constexpr const char* kShiftUp = "ShiftUp";
inline constexpr const char* kShiftDown = "ShiftDown";

// Adds both arrows, lit, to a model with the cluster's "GearPanel". Throws std::runtime_error if it has none.
void add_shift_light(engine::Model& model);

}  // namespace gearshift::cabin
