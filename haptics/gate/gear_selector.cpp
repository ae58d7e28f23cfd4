#include "haptics/gate/gear_selector.h"

#include "haptics/gate/gate_feel.h"

namespace gearshift::haptics {
namespace {

// The gear at this lever position, given the gear that is engaged now. Between release depth and engage depth nothing
// changes. A gear stays engaged only while the lever is in its slot.
int gear_at(const Gate& gate, glm::dvec2 proxy, int engaged) noexcept {
  const int index = slot_at(gate, proxy);
  if (index == kNoSlot) return kNeutralGear;
  const Slot& slot = slot_of(gate, index);
  const double depth = depth_in(gate, index, proxy);
  if (depth >= slot.engage_depth) return slot.gear;
  return slot.gear == engaged && depth >= slot.release_depth ? engaged : kNeutralGear;
}

}  // namespace

int GearSelector::update(const Gate& gate, glm::dvec2 proxy, double period) noexcept {
  const int current = gear_at(gate, proxy, lever_);
  if (current != candidate_) {
    candidate_ = current;
    candidate_time_ = 0.0;
  } else {
    candidate_time_ += period;
  }
  if (candidate_ != lever_ && candidate_time_ >= debounce_) lever_ = candidate_;
  if (is_sequential(gate))
    turn_drum(gate, proxy);
  else
    gear_ = lever_;
  return gear_;
}

void GearSelector::turn_drum(const Gate& gate, glm::dvec2 proxy) noexcept {
  if (lever_ == kNeutralGear) {
    if (slot_at(gate, proxy) == kNoSlot) is_ready_ = true;
    return;
  }
  if (!is_ready_) return;
  gear_ = gear_behind(gate, slot_of_gear(gate, lever_), gear_);
  is_ready_ = false;
}

}  // namespace gearshift::haptics
