// Compiles a layout into a gate with walls, junction rules, buffers, locks and the return to neutral. The paper leaves
// this to future work.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

inline constexpr double kPaperYokeRadius = 0.120;  // [m] distance from the yoke's centre to the tip

// Compiles the layout. `workspace`: reach [m] of the device's tip along each axis. `radius`: radius [m] of the sphere
// on which the tip moves, which limits its reach in the corners (see reaches() in gate_checks.h); infinite for a device
// that reaches the whole rectangle. Throws FileError with line and reason if the layout is impossible, for example
// because of overlapping columns, an unreachable gear, an aisle that is too narrow, or a part outside the workspace.
Gate compile_gate(const GateLayout& layout, glm::dvec2 workspace, double radius = kPaperYokeRadius);

}  // namespace gearshift::haptics
