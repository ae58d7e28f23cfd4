// A line on stdout for each gear that came, each over-push, each change of the guard, and for a lever's whole time: for
// people and scripts that watch.
#pragma once

#include <cstdio>
#include <optional>
#include <span>

#include "app/event_words.h"
#include "app/print_out.h"
#include "app/trainer/trainer.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

// time_ns: since the start of the session. push_estimated: the device has no force sensor.
inline void print_events(std::span<const HapticEvent> events, bool push_estimated) {
  for (const HapticEvent& event : events) {
    const bool told = event.kind == EventKind::gear_engaged || event.kind == EventKind::over_push_begin ||
                      event.kind == EventKind::guard_changed;
    if (told)
      print_out("{:8.3f} s  {}\n", 1e-9 * static_cast<double>(event.time_ns), event_words(event, push_estimated));
  }
  if (!events.empty()) std::fflush(stdout);
}

// How a lever kept its time from its first cycle to its last.
inline void print_health(const std::optional<LoopHealth>& health) {
  if (!health) return;
  print_out("loop: {} deadlines missed, {} cycles too long, {} events lost, {}\n", health->skipped, health->overruns,
            health->events_lost, health->realtime ? "real-time" : "not real-time");
  std::fflush(stdout);
}

}  // namespace gearshift
