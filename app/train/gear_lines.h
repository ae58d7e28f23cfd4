// A line on stdout for each gear that came or went, and each change of the guard: for people and scripts that watch.
#pragma once

#include <cstdio>
#include <span>

#include <fmt/core.h>

#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

inline void print_events(std::span<const HapticEvent> events, double time) {
  for (const HapticEvent& event : events) {
    if (event.kind == EventKind::gear_engaged) {
      fmt::print("{:8.3f} s  {} engaged\n", time, gear_name(static_cast<int>(event.value)));
    } else if (event.kind == EventKind::over_push_begin) {
      fmt::print("{:8.3f} s  pushed with {:.0f} N\n", time, event.value);
    } else if (event.kind == EventKind::guard_changed) {
      fmt::print("{:8.3f} s  {}\n", time, guard_state_name(static_cast<GuardState>(static_cast<int>(event.value))));
    }
  }
  if (!events.empty()) std::fflush(stdout);
}

}  // namespace gearshift
