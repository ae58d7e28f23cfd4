// Plane figures for what is cut out of a plate.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift {

using Loop = std::vector<glm::dvec2>;  // [m] closed: the last point is joined to the first

double signed_area(const Loop& loop) noexcept;  // [m^2] > 0: counter-clockwise

// The closed line with as few of its points as keep it within `tolerance` [m] of the others (Douglas & Peucker 1973).
Loop simplified(const Loop& loop, double tolerance);

// Triangles (indices into outline, then hole) of what lies inside the outline and outside the hole. Ears are clipped
// after a bridge has joined the two (Eberly, Triangulation by Ear Clipping, 2002). outline: counter-clockwise and
// convex; hole: clockwise, inside it. Throws std::runtime_error where a loop crosses itself so that no ear is left.
std::vector<std::uint32_t> triangulate(const Loop& outline, const Loop& hole);

// Rectangle about the origin with round corners, counter-clockwise.
Loop rounded_rectangle(glm::dvec2 half, double radius, int steps_per_corner);

}  // namespace gearshift
