// The driver's side.
#pragma once

#include <glm/vec3.hpp>

namespace gearshift::cabin {

enum class DriveSide { left, right };

// [m] x of the plane at which the left-hand-drive cabin is mirrored to get the right-hand-drive one. The plane passes
// through the lever, so that lever and gate stay within the console's opening. The plane is 5 mm from the car's centre
// plane, which shifts the car by 1 cm. The shift is not visible because the road is shifted too.
inline constexpr double kMirrorPlane = 0.330;

inline glm::dvec3 on_side(DriveSide side, glm::dvec3 point) noexcept {
  if (side == DriveSide::right) point.x = 2.0 * kMirrorPlane - point.x;
  return point;
}

}  // namespace gearshift::cabin
