// The Pareto front of several methods: those that no other method beats in both cost and error.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::lab {

// Indices of the points (cost, error) on the front, cheapest first. A point is beaten by one that is no worse in both
// and better in one, so equal points are both on the front. Points that are not finite are never on it.
std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points);

}  // namespace gearshift::lab
