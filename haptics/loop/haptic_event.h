// Events: changes that a user should see and a lesson may count, found by comparing each cycle with the one before.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/loop/haptic_loop.h"

namespace gearshift::haptics {

enum class EventKind : std::uint8_t {
  gear_engaged,     // value: gear
  gear_left,        // value: gear left
  wall_contact,     // value: impact speed [m/s]
  over_push_begin,  // value: push [N]
  over_push_end,
  saturation_begin,  // value: wanted force [N]
  saturation_end,
  guard_changed,     // value: GuardState
  stiffness_lowered  // value: new stiffness [N/m]; the lever chattered on a wall
};

struct HapticEvent {
  EventKind kind = EventKind::gear_engaged;
  std::uint64_t cycle = 0;
  std::int64_t time_ns = 0;  // [ns]
  double value = 0.0;
};

// For example "2 engaged" or "wall hit at 0.31 m/s". push_estimated: the device has no force sensor, so the push is
// marked as estimated.
std::string describe(const HapticEvent& event, bool push_estimated = false);

// Finds the events of a run from its cycles (HapticLoop::published). Not for the haptic thread: it allocates.
class EventDetector {
 public:
  // Call for each cycle in order. Appends this cycle's events. If cycles are missing, their events are too, but a change
  // that lasts, such as a new gear, is found at the next cycle. A cycle number that does not rise begins a new loop.
  void update(const TraceSample& now, std::vector<HapticEvent>& events);

 private:
  TraceSample previous_;
  std::int64_t touched_ns_ = kNeverTouched;  // [ns] last cycle with contact

  static constexpr std::int64_t kNeverTouched = -1'000'000'000'000'000'000;
};

}  // namespace gearshift::haptics
