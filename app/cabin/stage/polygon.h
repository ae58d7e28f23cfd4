// Polygons for cutting openings out of a plate.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::cabin {

using Loop = std::vector<glm::dvec2>;  // [m] closed polygon: the last point is connected to the first

double signed_area(const Loop& loop) noexcept;  // [m^2] positive for a counter-clockwise loop

// Returns a polygon with fewer points; all dropped points are within `tolerance` [m] of the result (Douglas & Peucker
// 1973).
Loop simplified(const Loop& loop, double tolerance);

// Triangulates the area inside the outline and outside the hole: joins the two loops with a bridge and clips ears
// (Eberly, Triangulation by Ear Clipping, 2002). Returns three indices per triangle, into the points of the outline
// followed by those of the hole. outline: counter-clockwise and convex. hole: clockwise, inside the outline. Throws
// std::runtime_error if no ear can be found because a loop crosses itself.
std::vector<std::uint32_t> triangulate(const Loop& outline, const Loop& hole);

// A rectangle around the origin with rounded corners, counter-clockwise. half: half the width and half the height.
Loop rounded_rectangle(glm::dvec2 half, double radius, int steps_per_corner);

}  // namespace gearshift::cabin
