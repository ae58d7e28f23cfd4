// The paper's future work: from a layout to walls, junction rules, buffers, locks and the neutral return.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift {

inline constexpr double kPaperYokeRadius = 0.120;  // [m] centre to tip

// Assembles the gate.
// workspace: how far the device's tip reaches along each axis. [m]
// radius: of the sphere on which it moves, which keeps it out of the corners (`reaches` in gate_checks.h);
// infinite for a device that reaches the whole rectangle. [m]
// Throws FileError with line and reason where the layout is impossible: columns that overlap, a gear that
// cannot be reached, an aisle too narrow, two neutrals, a part outside the workspace.
Gate compile_gate(const GateLayout& layout, glm::dvec2 workspace, double radius = kPaperYokeRadius);

}  // namespace gearshift
