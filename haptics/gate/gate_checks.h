// Checks that reject impossible gate layouts.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

// Smallest thickness [m] of the wall between the mouths of two neighbouring columns.
inline constexpr double kMinWall = 0.002;

// Largest slope [N/m] of the gate's forces. It is lower than the paper's wall stiffness, so that no force feels like a
// wall.
inline constexpr double kMaxFeelSlope = 4000.0;

// Free travel [m] required behind every wall and, in a corner, behind both walls. The paper's wall of 5000 N/m reaches
// its full 31.7 N at a depth of 6.3 mm, and this must happen before the device's hard stop.
inline constexpr double kWorkspaceMargin = 0.007;

// True if the tip of a yoke can reach a point. The tip moves on a sphere, and two joints turn it about the sphere's
// centre, each up to its stop: tan(theta) = x / z and tan(phi) = -y / z with z = sqrt(radius^2 - x^2 - y^2). A stop is
// a great circle of this sphere, which is an ellipse in the gate plane:
//
//     (x / half.x)^2 + (y / radius)^2 <= 1      half.x = radius sin(stop of theta)
//     (x / radius)^2 + (y / half.y)^2 <= 1      half.y = radius sin(stop of phi)
//
// `half`: reach along each axis [m]. With an infinite radius the region is a rectangle.
bool reaches(glm::dvec2 half, double radius, glm::dvec2 point) noexcept;

// Throws FileError with file, line and reason for the first error found. `workspace` and `radius` [m] are the
// parameters `half` and `radius` of reaches().
void check_layout(const GateLayout& layout, glm::dvec2 workspace, double radius);

// Largest absolute slope |dF/dx| [N/m] of a curve.
double steepest(const FeelCurve& curve) noexcept;

// Force towards neutral [N] that a lever at this distance [m] from the middle of the workspace needs, because the
// handle's own spring pulls to the middle.
double required_return_force(double distance) noexcept;

// Throws FileError if a buffer would hold a free lever at its closed wall. This check needs the compiled gate.
void check_buffers(const GateLayout& layout, const Gate& gate);

}  // namespace gearshift::haptics
