#include "haptics/gate/gear_selector.h"

#include <cmath>

#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

// The gear that the lever's place stands for, given the one engaged: between release and engage depth nothing
// changes, and a gear can only be kept in its own slot.
int gear_at(const Gate& gate, glm::dvec2 proxy, int engaged) noexcept {
  const int index = slot_at(gate, proxy);
  if (index == kNoSlot) return kNeutralGear;
  const Slot& slot = slot_of(gate, index);
  const double depth = std::abs(proxy.y);
  if (depth >= slot.engage_depth) return slot.gear;
  return slot.gear == engaged && depth >= slot.release_depth ? engaged : kNeutralGear;
}

}  // namespace

int GearSelector::update(const Gate& gate, glm::dvec2 proxy, double period) noexcept {
  const int seen = gear_at(gate, proxy, gear_);
  if (seen != candidate_) {
    candidate_ = seen;
    held_ = 0.0;
  } else {
    held_ += period;
  }
  if (candidate_ != gear_ && held_ >= debounce_) gear_ = candidate_;
  return gear_;
}

}  // namespace gearshift
