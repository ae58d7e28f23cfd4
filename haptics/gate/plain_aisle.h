// The simplest gate: one straight aisle without feel. Used to study a single wall, and as open space for emulated
// mechanical elements.
#pragma once

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// Free space |x| <= half_length, |y| <= half_width, no slot, no feel. [m], > 0
Gate plain_aisle(double half_length, double half_width) noexcept;

}  // namespace gearshift::haptics
