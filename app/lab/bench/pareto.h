// The Pareto front of several methods: those that no other method beats in both cost and error.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::lab {

// Returns the indices of the points (cost, error) on the front, cheapest first. Point A beats point B if A is no worse
// in both values and better in one, so equal points are all on the front. Non-finite points are never on the front.
std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points);

}  // namespace gearshift::lab
