// The lever in the cabin's axes: x right (select), y up, z back (against shift).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptics/joystick/kinematics.h"

namespace gearshift::cabin {

inline constexpr double kDrawnLever = 0.120;  // [m] pivot to knob centre in the cabin model

// Unit vector along the lever with its tip above a point of the gate plane, from the yoke's joint angles. Points out of
// reach are limited to 0.98 of the yoke's radius.
glm::dvec3 lever_direction(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// The shortest rotation of the upright lever into that direction, without twist.
glm::dquat lever_rotation(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

}  // namespace gearshift::cabin
