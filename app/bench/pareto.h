// Which of several methods are worth having: those that no other beats in cost and error at once.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift {

// Of points (cost, error) those of the front, the cheapest first. A point is beaten by one that is no worse in both and
// better in one; so equal points stay together. Points that are not finite are never on it.
std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points);

}  // namespace gearshift
