#include "app/cabin/stage/lever_pose.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace gearshift::cabin {

glm::dvec3 lever_direction(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept {
  const double furthest = 0.98 * yoke.radius;
  const double off = glm::length(plane);
  const haptics::JointAngles q =
      haptics::joint_angles_from_plane(yoke, off > furthest ? furthest / off * plane : plane);
  const glm::dvec3 tip = haptics::tip_position(yoke, q) / yoke.radius;  // device axes: x select, y shift, z up
  return {tip.x, tip.z, -tip.y};
}

glm::dquat lever_rotation(const haptics::YokeGeometry& yoke, glm::dvec2 plane) noexcept {
  // The rotation from the y axis to d has the axis y x d and a half angle with the cosine (1 + d_y) / |y + d|. This
  // works because the lever is never upside down.
  const glm::dvec3 d = lever_direction(yoke, plane);
  return glm::normalize(glm::dquat(1.0 + d.y, d.z, 0.0, -d.x));
}

}  // namespace gearshift::cabin
