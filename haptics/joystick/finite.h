// Tests whether every component of a vector is finite.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>

namespace gearshift::haptics {

inline bool is_finite(glm::dvec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace gearshift::haptics
