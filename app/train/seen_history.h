// The lever in the cycles of a frame, as plots take it.
#pragma once

#include <span>
#include <vector>

#include "app/trainer/history.h"
#include "app/training/drive_sample.h"

namespace gearshift {

inline std::vector<HapticSnapshot> seen_history(std::span<const DriveSample> cycles) {
  constexpr std::size_t kMost = 200;  // snapshots
  std::vector<HapticSnapshot> levers;
  levers.reserve(cycles.size());
  for (const DriveSample& cycle : cycles) levers.push_back(cycle.lever);
  return thinned(levers, kMost);
}

}  // namespace gearshift
