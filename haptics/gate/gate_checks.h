// Checks for impossible gate layouts.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

// Smallest solid wall between the mouths of two columns. [m]
inline constexpr double kMinWall = 0.002;

// Steepest allowed slope of the feel: softer than the paper's wall, so that it does not feel like a wall. [N/m]
inline constexpr double kMaxFeelSlope = 4000.0;

// Free travel required behind every wall, and behind both walls in a corner: the paper's wall of 5000 N/m reaches its
// full 31.7 N at 6.3 mm, which must come before the hard stop. [m]
inline constexpr double kWorkspaceMargin = 0.007;

// Whether the tip of a yoke can reach a point. Two joints turn it about the centre of the sphere on which it moves,
// each up to its stop: tan(theta) = x / z and tan(phi) = -y / z with z = sqrt(radius^2 - x^2 - y^2). A stop is a great
// circle of that sphere, and so an ellipse in the gate plane:
//
//     (x / half.x)^2 + (y / radius)^2 <= 1      half.x = radius sin(stop of theta)
//     (x / radius)^2 + (y / half.y)^2 <= 1      half.y = radius sin(stop of phi)
//
// half [m]: reach along each axis. With an infinite radius the region is a rectangle.
bool reaches(glm::dvec2 half, double radius, glm::dvec2 point) noexcept;

// Throws FileError with file, line and reason for the first error found.
// workspace and radius: half and radius of reaches(). [m]
void check_layout(const GateLayout& layout, glm::dvec2 workspace, double radius);

// Throws FileError if a buffer would hold a free lever at its closed wall. This check needs the assembled gate.
void check_buffers(const GateLayout& layout, const Gate& gate);

}  // namespace gearshift::haptics
