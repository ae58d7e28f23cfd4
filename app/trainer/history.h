// Fewer snapshots that still show what happened.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

// At most `most` of them, in order; all where that is enough. Else they are cut into most / 2 even parts, and of each
// the weakest and the strongest push |f_h| stay: a peak is never thinned away. most 1: the strongest of all.
std::vector<HapticSnapshot> thinned(const std::vector<HapticSnapshot>& all, std::size_t most);

}  // namespace gearshift
