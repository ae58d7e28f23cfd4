// Prints lines on stdout for users and scripts that follow the session: one per engaged gear, over-push and state
// change of the force guard, and one with the loop's health.
#pragma once

#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include "app/base/console.h"
#include "app/runtime/runtime.h"
#include "haptics/loop/haptic_event.h"

namespace gearshift::session {

// The event times must count from the start of the session. `push_estimated`: true if the device has no force sensor.
// `gate`: names the gears.
inline void print_events(std::span<const haptics::HapticEvent> events, bool push_estimated, const haptics::Gate& gate) {
  for (const haptics::HapticEvent& event : events) {
    const bool is_printed = event.kind == haptics::EventKind::gear_engaged ||
                            event.kind == haptics::EventKind::over_push_begin ||
                            event.kind == haptics::EventKind::guard_changed;
    if (!is_printed) continue;
    const bool is_gear = event.kind == haptics::EventKind::gear_engaged;
    base::print_out("{:8.3f} s  {}\n", 1e-9 * static_cast<double>(event.time_ns),
                    is_gear ? std::string(haptics::gear_label(gate, static_cast<int>(event.value))) + " engaged"
                            : haptics::describe(event, push_estimated));
  }
  if (!events.empty()) std::fflush(stdout);
}

// Prints how well the loop has met its deadlines since its first cycle.
inline void print_health(const std::optional<runtime::LoopHealth>& health) {
  if (!health) return;
  base::print_out("loop: {} deadlines missed, {} cycles too long, {} cycles unread, {}\n", health->skipped,
                  health->overruns, health->lost, health->realtime ? "real-time" : "not real-time");
  std::fflush(stdout);
}

}  // namespace gearshift::session
