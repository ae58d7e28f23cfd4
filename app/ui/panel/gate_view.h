// The gate from above: walls, gears, lever point, proxy, trajectory, forces.
#pragma once

#include <imgui.h>

#include <span>

#include <glm/vec2.hpp>

#include "app/ui/panel/trail.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::ui {

// Paths of a replayed shift in the gate plane [m]: the driven path and the shortest one. May be empty.
struct ShownPaths {
  std::span<const glm::dvec2> driven{}, ideal{};
};

// Draws the view at ImGui's cursor, `size` [px] large. `description`: describe_gate(gate), which allocates memory.
// `max_force` [N]: the device's limit, which scales the arrows.
void draw_gate_view(ImVec2 size, const haptics::Gate& gate, const haptics::GateDescription& description,
                    const haptics::HapticSnapshot& now, const Trail& trail, double max_force,
                    const ShownPaths& paths = {});

}  // namespace gearshift::ui
