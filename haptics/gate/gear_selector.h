// Determines the engaged gear, at most one at a time. Uses hysteresis in depth and debouncing in time. In a sequential
// gate, one stroke of the lever changes the gear once; the next stroke begins in the neutral aisle.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

class GearSelector {
 public:
  // `debounce`: [s]. `start`: the gear of a sequential gate at the start.
  explicit GearSelector(double debounce, int start = kNeutralGear) noexcept : debounce_(debounce), gear_(start) {}

  // `proxy`: position of the drawn lever [m]. `period`: cycle time [s]. Returns the engaged gear. Real-time safe.
  int update(const Gate& gate, glm::dvec2 proxy, double period) noexcept;

  int gear() const noexcept { return gear_; }

 private:
  void turn_drum(const Gate& gate, glm::dvec2 proxy) noexcept;

  double debounce_;
  double candidate_time_ = 0.0;  // [s] time since the candidate gear was first detected
  int gear_;
  int lever_ = kNeutralGear;  // Slot::gear where the lever is
  int candidate_ = kNeutralGear;
  bool is_ready_ = false;  // the lever has been in the neutral aisle since the last stroke
};

}  // namespace gearshift::haptics
