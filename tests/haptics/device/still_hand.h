// A hand for tests that always wants the same.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/device/hand.h"

namespace gearshift {

class StillHand final : public HandDriver {
 public:
  StillHand() = default;
  explicit StillHand(const HandTarget& wanted) : target(wanted) {}
  HandTarget next(double, glm::dvec2) noexcept override { return target; }

  HandTarget target;
};

inline HandTarget hand_at(glm::dvec2 position) {
  HandTarget target;
  target.position = position;
  return target;
}

inline HandTarget hand_pushing(glm::dvec2 push) {
  HandTarget target;
  target.push = push;
  return target;
}

}  // namespace gearshift
