// The gate from above: walls, gears, lever, drawn lever, trajectory, forces.
#pragma once

#include <imgui.h>

#include <span>

#include <glm/vec2.hpp>

#include "app/panel/trail.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// Of a shift that is looked at: the way that it took, and the shortest. [m] in the gate plane; empty: none
struct SeenWays {
  std::span<const glm::dvec2> driven{}, ideal{};
};

// In that size at the cursor [px]. most_force [N]: of the device, the length of the longest arrow.
void draw_gate_view(ImVec2 size, const Gate& gate, const HapticSnapshot& now, const Trail& trail, double most_force,
                    const SeenWays& ways = {});

}  // namespace gearshift
