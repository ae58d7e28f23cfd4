// Which layouts are impossible, and why.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate_layout.h"

namespace gearshift {

// [m] of solid wall between the mouths of two columns.
inline constexpr double kMinWall = 0.002;

// [N/m] Softer than the paper's wall: feel must not pass for one.
inline constexpr double kSteepestFeel = 4000.0;

// [m] left behind every wall, and behind both walls in every corner: the paper's
// wall of 5000 N/m gives all of its 31.7 N at 6.3 mm, before the hard stop does.
inline constexpr double kWorkspaceMargin = 0.007;

// What the tip of a yoke reaches. Two joints turn it about the centre of the sphere on which it moves, each
// up to its stop: tan(theta) = x / z and tan(phi) = -y / z with z = sqrt(radius^2 - x^2 - y^2).
// A stop is a great circle of that sphere, and so an ellipse over the gate plane:
//
//     (x / half.x)^2 + (y / radius)^2 <= 1      half.x = radius sin(stop of theta)
//     (x / radius)^2 + (y / half.y)^2 <= 1      half.y = radius sin(stop of phi)
//
// half [m]: how far it reaches along each axis. An infinite radius makes it the rectangle.
bool reaches(glm::dvec2 half, double radius, glm::dvec2 point) noexcept;

// Throws FileError with file, line and reason for the first thing that cannot be.
// workspace and radius: half and radius of reaches(). [m]
void check_layout(const GateLayout& layout, glm::dvec2 workspace, double radius);

// The same for what shows only in the assembled gate: a buffer must not hold a free lever at its closed wall.
void check_buffers(const GateLayout& layout, const Gate& gate);

}  // namespace gearshift
