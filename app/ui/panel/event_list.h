// A list of recent events as text: gears, impacts, warnings, guard changes.
#pragma once

#include <deque>
#include <span>

#include "haptics/loop/haptic_event.h"

namespace gearshift::ui {

class EventList {
 public:
  void add(std::span<const haptics::HapticEvent> events);
  // Draws as many events as fit in the rest of the window, newest first. `push_estimated`: true if the device has no
  // force sensor.
  void draw(bool push_estimated) const;

 private:
  static constexpr std::size_t kMaxEvents = 64;
  std::deque<haptics::HapticEvent> events_;  // oldest first
};

}  // namespace gearshift::ui
