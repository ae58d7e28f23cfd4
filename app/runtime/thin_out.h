// Reduces the number of snapshots in a list so that all force peaks remain visible.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "app/vehicle/drive_sample.h"

namespace gearshift::runtime {

// Replaces `few` by at most `max_count` snapshots of the cycles, in order. A longer list is split into max_count / 2
// equal parts, and only the snapshots with the smallest and the largest hand force |f_h| of each part are kept. For
// max_count = 1, only the snapshot with the largest force in the list is kept.
void thin_out(std::span<const vehicle::DriveSample> cycles, std::size_t max_count,
              std::vector<haptics::HapticSnapshot>& few);

}  // namespace gearshift::runtime
