// Random mechanisms of straight aisles for property tests: trees of oblique aisles, and turned grids.
#pragma once

#include <cstdint>

#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {

// Returns a layout that the gate compiler accepts for the paper's joystick. Equal seeds give equal layouts on every
// machine. Odd seeds give trees, even seeds grids, which have loops of aisles.
haptics::GateLayout random_mechanism(std::uint64_t seed);

}  // namespace gearshift::lab
