// The shift drum of a sequential gearbox: which sleeve the lever moves, and where it is. The first part of a stroke pulls
// the old gear's sleeve out, and the rest pushes the new one in. Then the lever returns without any sleeve. The forces
// come from the same synchronisers as in other gates. In a gate with a slot per gear, each slot has its own sleeve, which
// moves with the lever.
#pragma once

#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

// A gate with one slot per sleeve: `gate` itself, or the gears of a sequential gate, whose slots have equal depths.
haptics::Gate sleeves_of(const haptics::Gate& gate) noexcept;

class ShiftDrum {
 public:
  explicit ShiftDrum(const haptics::Gate& gate) noexcept;

  struct Sleeve {
    int slot = haptics::kNoSlot;  // in sleeves_of()
    double depth = 0.0;           // [m]
    double way = 0.0;  // +1: the sleeve moves in as the lever leaves neutral, -1: it moves out, 0: the lever is free
  };
  // Returns the sleeve of this cycle. Real-time safe.
  Sleeve turn(const haptics::LeverInput& lever) noexcept;

  // The lever's depth [m] at which a sleeve that moves out is at `depth`.
  double lever_depth(double depth) const noexcept;

 private:
  int sleeve_of(int gear) const noexcept;
  Sleeve seated(int gear) const noexcept;

  haptics::Gate gate_, sleeves_;
  double mouth_ = 0.0, crest_ = 0.0, rest_ = 0.0;  // [m] depths in each slot
  int stroke_slot_ = haptics::kNoSlot;             // slot of the lever's stroke
  int from_ = haptics::kNeutralGear, to_ = haptics::kNeutralGear;
};

}  // namespace gearshift::vehicle
