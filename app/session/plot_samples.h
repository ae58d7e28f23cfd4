// Reduces the cycles of one frame to the lever samples that the plots draw.
#pragma once

#include <span>
#include <vector>

#include "app/runtime/thin_out.h"
#include "app/vehicle/drive_sample.h"

namespace gearshift::session {

inline std::vector<haptics::HapticSnapshot> plot_samples(std::span<const vehicle::DriveSample> cycles) {
  constexpr std::size_t kMaxSnapshots = 200;
  std::vector<haptics::HapticSnapshot> levers;
  levers.reserve(cycles.size());
  for (const vehicle::DriveSample& cycle : cycles) levers.push_back(cycle.lever);
  return runtime::thin_out(levers, kMaxSnapshots);
}

}  // namespace gearshift::session
