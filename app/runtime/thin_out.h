// Reduces a list of snapshots to fewer that still show all force peaks.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::runtime {

// Returns at most `max_count` of the snapshots, in order. If there are more, they are split into max_count / 2 equal
// parts, and the snapshots with the smallest and the largest hand force |f_h| of each part are kept. max_count = 1:
// only the one with the largest force of all.
std::vector<haptics::HapticSnapshot> thin_out(const std::vector<haptics::HapticSnapshot>& all, std::size_t max_count);

}  // namespace gearshift::runtime
