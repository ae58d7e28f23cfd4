// The simplest gate: one straight aisle and nothing to feel in it. A wall to be studied by itself, and an open
// space for emulated elements.
#pragma once

#include "haptics/gate/gate.h"

namespace gearshift {

// Free space |x| <= half_length, |y| <= half_width, no slot, no feel. [m], > 0
Gate plain_aisle(double half_length, double half_width) noexcept;

}  // namespace gearshift
