// Reduces a list of snapshots to fewer that still show what happened.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::runtime {

// At most `most` of the snapshots, in order; all of them if they fit. Otherwise they are split into most / 2 equal
// parts, and the weakest and strongest push |f_h| of each part is kept, so that no peak is lost. most = 1: the
// strongest of all.
std::vector<haptics::HapticSnapshot> thin_out(const std::vector<haptics::HapticSnapshot>& all, std::size_t most);

}  // namespace gearshift::runtime
