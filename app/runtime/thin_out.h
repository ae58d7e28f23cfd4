// Reduces the number of snapshots in a list so that all force peaks remain visible.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::runtime {

// Returns at most `max_count` of the snapshots, in order. A longer list is split into max_count / 2 equal parts, and
// only the snapshots with the smallest and the largest hand force |f_h| of each part are returned. For max_count = 1,
// only the snapshot with the largest force in the list is returned.
std::vector<haptics::HapticSnapshot> thin_out(const std::vector<haptics::HapticSnapshot>& all, std::size_t max_count);

}  // namespace gearshift::runtime
