// Where the driver sits.
#pragma once

#include <glm/vec3.hpp>

namespace gearshift {

enum class DriveSide { left, right };

// [m] A right-hand-drive cabin is the left-hand-drive one in a mirror that stands in the lever, not in the car's middle,
// 5 mm beside it: so lever and gate stay where they are and the console's opening stays about them; that the car stands
// 1 cm further left nobody sees, as its road does too.
inline constexpr double kMirrorPlane = 0.330;

inline glm::dvec3 on_side(DriveSide side, glm::dvec3 point) noexcept {
  if (side == DriveSide::right) point.x = 2.0 * kMirrorPlane - point.x;
  return point;
}

}  // namespace gearshift
