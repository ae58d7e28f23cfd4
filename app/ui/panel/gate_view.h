// The gate from above: walls, gears, lever point, proxy, trajectory, forces.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>

#include <glm/vec2.hpp>

#include "app/ui/panel/trail.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::ui {

// Paths in the gate plane [m]: the driven path of a replayed shift and the shortest one, or the way to the gear that the
// lesson wants. May be empty.
struct ShownPaths {
  std::span<const glm::dvec2> driven{}, ideal{};
  int wanted_gear = haptics::kNeutralGear;  // its slot is lit; kNeutralGear: none
};

// Draws the view at ImGui's cursor, `size` [px] large. `description`: describe_gate(gate), which allocates memory.
// `max_force` [N]: the device's limit, which scales the arrows; 0: without arrows and scales.
void draw_gate_view(ImVec2 size, const haptics::Gate& gate, const haptics::GateDescription& description,
                    const haptics::HapticSnapshot& now, const Trail& trail, double max_force,
                    const ShownPaths& paths = {});

// The gear whose slot or label is at the place `at` [px] of a view that fills the last ImGui item; neutral between the
// slots; empty beside the gate.
std::optional<int> gear_at(const haptics::Gate& gate, const haptics::GateDescription& description, ImVec2 at);

}  // namespace gearshift::ui
