// The force along a slot as a small plot: above the axis it pulls into the gear, below it pushes back.
#pragma once

#include "app/draw/svg.h"
#include "haptics/gate/gate.h"

namespace gearshift {

void draw_slot_plot(Svg& svg, const Gate& gate, const Slot& slot, const Rect& box);

}  // namespace gearshift
