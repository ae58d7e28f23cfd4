// Plots the force along a slot. Positive forces pull the lever into the gear, negative ones push it back.
#pragma once

#include "app/base/svg.h"
#include "haptics/gate/gate.h"

namespace gearshift::lab {

void draw_slot_plot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, const base::Rect& box);

}  // namespace gearshift::lab
