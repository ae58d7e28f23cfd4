// The shortest way of a lever through a gate.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

// The shortest way through free space, all lockouts open, between two points of it: its ends and the corners at which
// it bends, no two neighbours equal (one point where the ends are the same). [m]
//
// A taut string in the comb bends only at the corners of the slots that hold its ends: at most at two on either side.
// Where an end is no point of free space it is the straight line.
std::vector<glm::dvec2> shortest_path(const Gate& gate, glm::dvec2 from, glm::dvec2 to);

double shortest_way(const Gate& gate, glm::dvec2 from, glm::dvec2 to);  // its length [m]

}  // namespace gearshift
