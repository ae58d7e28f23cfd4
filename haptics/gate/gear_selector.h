// Which gear is engaged: hysteresis in depth, debounce in time, one gear at most.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

class GearSelector {
 public:
  explicit GearSelector(double debounce) noexcept : debounce_(debounce) {}  // [s]

  // proxy [m]: the drawn lever; period [s]. Returns the engaged gear. Real-time safe.
  int update(const Gate& gate, glm::dvec2 proxy, double period) noexcept;

  int gear() const noexcept { return gear_; }

 private:
  double debounce_;
  double held_ = 0.0;  // [s] that the candidate has been seen
  int gear_ = kNeutralGear;
  int candidate_ = kNeutralGear;
};

}  // namespace gearshift
