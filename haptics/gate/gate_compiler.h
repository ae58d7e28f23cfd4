// Compiles a layout into walls, junction rules, buffers, locks and the neutral return: the paper's future work.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

inline constexpr double kPaperYokeRadius = 0.120;  // [m] centre to tip

// Assembles the gate.
// workspace: reach of the device's tip along each axis. [m]
// radius: radius of the sphere on which the tip moves, which limits its reach in the corners (`reaches` in
// gate_checks.h); infinite for a device that reaches the whole rectangle. [m] Throws FileError with line and reason if
// the layout is impossible, for example overlapping columns, an unreachable gear, an aisle that is too narrow, or a
// part outside the workspace.
Gate compile_gate(const GateLayout& layout, glm::dvec2 workspace, double radius = kPaperYokeRadius);

}  // namespace gearshift::haptics
