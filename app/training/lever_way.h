// The lever's way from gear to gear in words, in whatever gate it is.
#pragma once

#include <string>

#include "haptics/gate/gate.h"

namespace gearshift {

// "Straight back.", "Into the aisle, right against the spring, then forward.", "Lift the ring: left, then forward."
// from: kNeutralGear for the aisle at rest. Both must be in the gate.
std::string lever_way(const Gate& gate, int from, int to);

}  // namespace gearshift
