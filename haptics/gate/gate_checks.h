// Which layouts are impossible, and why.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate_layout.h"

namespace gearshift {

inline constexpr double kMinAisleWidth = 0.004;  // [m] 53 counts of the paper's encoder
inline constexpr double kMinWall = 0.002;        // [m] of solid wall between the mouths of two columns
inline constexpr double kMinSlotProper = 0.010;  // [m] of slot behind its mouth
inline constexpr double kSteepestFeel =
    4000.0;  // [N/m] softer than the paper's wall: feel must not pass for a wall
inline constexpr double kWorkspaceMargin =
    0.007;  // [m] left behind every wall: the paper's wall of 5000 N/m gives
            // all of its 31.7 N at 6.3 mm, before the hard stop does

// Throws FileError with file, line and reason for the first thing that cannot be. workspace: half extent [m].
void check_layout(const GateLayout& layout, glm::dvec2 workspace);

// The same for what shows only in the assembled gate: a buffer must not hold a free lever at its closed wall.
void check_buffers(const GateLayout& layout, const Gate& gate);

}  // namespace gearshift
