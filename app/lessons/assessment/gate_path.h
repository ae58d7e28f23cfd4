// The shortest path of a lever through a gate.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Returns the shortest path [m] between two points through the gate's free space, with all lockouts open: the two end
// points and the corners between them. Consecutive points differ. If the end points coincide, the path is one point.
//
// The path bends only at corners of the slots that contain its end points, at most two per end point. If an end point
// lies outside free space, the path is a straight line.
std::vector<glm::dvec2> shortest_path(const haptics::Gate& gate, glm::dvec2 from, glm::dvec2 to);

double shortest_path_length(const haptics::Gate& gate, glm::dvec2 from, glm::dvec2 to);  // [m]

}  // namespace gearshift::lessons
