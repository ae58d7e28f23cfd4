// Determines the engaged gear, at most one at a time. Uses hysteresis in depth and debouncing in time.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

class GearSelector {
 public:
  explicit GearSelector(double debounce) noexcept : debounce_(debounce) {}  // [s]

  // `proxy`: position of the drawn lever [m]. `period`: cycle time [s]. Returns the engaged gear. Real-time safe.
  int update(const Gate& gate, glm::dvec2 proxy, double period) noexcept;

  int gear() const noexcept { return gear_; }

 private:
  double debounce_;
  double candidate_time_ = 0.0;  // [s] time since the candidate gear was first detected
  int gear_ = kNeutralGear;
  int candidate_ = kNeutralGear;
};

}  // namespace gearshift::haptics
