// The simplest gate: one straight aisle without forces. Used to study a single wall, and as open space for emulated
// mechanical elements.
#pragma once

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// Returns a gate with the free space |x| <= half_length, |y| <= half_width [m], both > 0, and with neither slots nor
// forces.
Gate plain_aisle(double half_length, double half_width) noexcept;

}  // namespace gearshift::haptics
