// The lever's pose in the cabin's axes: x right (select), y up, z back (against shift).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptics/joystick/kinematics.h"

namespace gearshift::cabin {

inline constexpr double kDrawnLever = 0.120;  // [m] pivot to knob centre in the cabin model

// Unit vector along the lever when its tip is above this point of the gate plane, from the yoke's joint angles. Points
// further away than 0.98 of the yoke's radius are limited to this distance.
glm::dvec3 lever_direction(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// The shortest rotation, without twist, of the upright lever into lever_direction().
glm::dquat lever_rotation(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

}  // namespace gearshift::cabin
