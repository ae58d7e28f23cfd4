// What the loop tells, in words.
#pragma once

#include <string>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

// "2 engaged", "wall hit at 0.31 m/s", ... push_estimated: by a device that has no force sensor, and it is said.
std::string event_words(const HapticEvent& event, bool push_estimated = false);

}  // namespace gearshift
