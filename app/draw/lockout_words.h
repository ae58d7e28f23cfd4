// When a lockout is open and when it is shut, in words: for the table and for the drawing's legend.
#pragma once

#include <string>

#include "haptics/gate/gate.h"

namespace gearshift {

// "shut above 20, open below 15 km/h"
std::string lockout_words(const Lockout& lockout);

}  // namespace gearshift
