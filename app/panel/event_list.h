// What happened last, in words: gears, impacts, warnings, the guard.
#pragma once

#include <deque>
#include <span>
#include <string>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

// "2 engaged", "wall hit at 0.31 m/s", ...
std::string event_words(const HapticEvent& event);

class EventList {
 public:
  void take(std::span<const HapticEvent> events);
  void draw() const;  // newest first, as many as the window's rest has room for

 private:
  static constexpr std::size_t kMost = 64;
  std::deque<HapticEvent> events_;  // oldest first
};

}  // namespace gearshift
