// The driver's side.
#pragma once

#include <glm/vec3.hpp>

namespace gearshift::cabin {

enum class DriveSide { left, right };

// [m] The right-hand-drive cabin is the left-hand-drive one mirrored at this plane, which passes through the lever, 5
// mm beside the car's centre plane. Lever and gate therefore stay in place within the console's opening. The car shifts
// 1 cm to the left, which is not visible because the road shifts with it.
inline constexpr double kMirrorPlane = 0.330;

inline glm::dvec3 on_side(DriveSide side, glm::dvec3 point) noexcept {
  if (side == DriveSide::right) point.x = 2.0 * kMirrorPlane - point.x;
  return point;
}

}  // namespace gearshift::cabin
