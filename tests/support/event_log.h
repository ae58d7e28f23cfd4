// Collects the events of a loop under test.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "haptics/loop/haptic_event.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::test {

class EventLog {
 public:
  // Call after every cycle.
  void see(const haptics::HapticLoop& loop) { detector_.update(loop.published(), events_); }

  std::vector<haptics::HapticEvent> of(haptics::EventKind kind) const {
    std::vector<haptics::HapticEvent> found;
    std::copy_if(events_.begin(), events_.end(), std::back_inserter(found),
                 [kind](const haptics::HapticEvent& event) { return event.kind == kind; });
    return found;
  }
  std::vector<int> engaged_gears() const {
    std::vector<int> gears;
    for (const haptics::HapticEvent& event : of(haptics::EventKind::gear_engaged))
      gears.push_back(static_cast<int>(event.value));
    return gears;
  }
  int count(haptics::EventKind kind) const { return static_cast<int>(of(kind).size()); }

 private:
  haptics::EventDetector detector_;
  std::vector<haptics::HapticEvent> events_;
};

}  // namespace gearshift::test
