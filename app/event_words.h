// What the loop tells, in words.
#pragma once

#include <string>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

// "2 engaged", "wall hit at 0.31 m/s", ...
std::string event_words(const HapticEvent& event);

}  // namespace gearshift
