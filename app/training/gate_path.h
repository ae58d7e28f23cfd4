// The shortest way of a lever through a gate.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

// Length of the shortest way through free space, all lockouts open, between two points of it. [m]
//
// A taut string in the comb bends only at the corners of the slots that hold its ends: at most at two on either side.
double shortest_way(const Gate& gate, glm::dvec2 from, glm::dvec2 to);

}  // namespace gearshift
