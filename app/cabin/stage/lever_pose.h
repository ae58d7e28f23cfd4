// The lever's pose in the cabin's axes: x right (select), y up, z back (against shift).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptics/joystick/kinematics.h"

namespace gearshift::cabin {

inline constexpr double kDrawnLever = 0.120;  // [m] from pivot to knob centre in the cabin model

// Unit vector along the lever when its tip is above the point `plane` [m] of the gate plane, computed with the yoke's
// joint angles. The point's distance from the origin is limited to 0.98 times the yoke's radius.
glm::dvec3 lever_direction(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// The shortest rotation, without twist, from the upright lever to lever_direction().
glm::dquat lever_rotation(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept;

}  // namespace gearshift::cabin
