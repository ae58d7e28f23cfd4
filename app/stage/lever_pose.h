// The lever in the cabin's axes: x right (select), y up, z back (against shift).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptics/joystick/kinematics.h"

namespace gearshift {

inline constexpr double kDrawnLever = 0.120;  // [m] pivot to knob centre in the cabin's model

// Unit vector along the lever whose tip is above a point of the gate plane, from the yoke's joint angles. A point that
// the yoke cannot reach is drawn to 0.98 of its radius.
glm::dvec3 lever_direction(const YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// Turns the upright lever into that direction without twist: the shortest way.
glm::dquat lever_rotation(const YokeGeometry& yoke, glm::dvec2 plane) noexcept;

}  // namespace gearshift
