// What happened last, in words: gears, impacts, warnings, the guard.
#pragma once

#include <deque>
#include <span>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

class EventList {
 public:
  void take(std::span<const HapticEvent> events);
  // Newest first, as many as the window's rest has room for. push_estimated: the device has no force sensor.
  void draw(bool push_estimated) const;

 private:
  static constexpr std::size_t kMost = 64;
  std::deque<HapticEvent> events_;  // oldest first
};

}  // namespace gearshift
