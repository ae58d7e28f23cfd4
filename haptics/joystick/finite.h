// Is every component a number?
#pragma once

#include <cmath>

#include <glm/vec2.hpp>

namespace gearshift {

inline bool is_finite(glm::dvec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace gearshift
