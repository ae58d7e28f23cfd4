// The shift light: two arrows above the gear display, of which at most one is shown.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace gearshift::cabin {

// Names of the arrows' nodes.
inline constexpr const char* kShiftUp = "ShiftUp";
inline constexpr const char* kShiftDown = "ShiftDown";

// Adds both arrows, lit, next to the node "GearPanel" of the model. Throws std::runtime_error if the node is missing.
void add_shift_light(engine::Model& model);

}  // namespace gearshift::cabin
