// The gate from above: walls, gears, lever, drawn lever, trajectory, forces.
#pragma once

#include <imgui.h>

#include "app/panel/trail.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// In that size at the cursor [px]. most_force [N]: of the device, the length of the longest arrow.
void draw_gate_view(ImVec2 size, const Gate& gate, const HapticSnapshot& now, const Trail& trail, double most_force);

}  // namespace gearshift
