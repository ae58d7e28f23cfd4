// The shortest path of a lever through a gate.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// The shortest path between two points through free space, with all lockouts open: its two ends and the corners between
// them [m]. Consecutive points differ; if the ends coincide, the path is a single point.
//
// Like a taut string, the path bends only at the corners of the slots that contain its ends, at most two per end. If an
// end lies outside free space, the path is the straight line.
std::vector<glm::dvec2> shortest_path(const haptics::Gate& gate, glm::dvec2 from, glm::dvec2 to);

double shortest_path_length(const haptics::Gate& gate, glm::dvec2 from, glm::dvec2 to);  // [m]

}  // namespace gearshift::lessons
