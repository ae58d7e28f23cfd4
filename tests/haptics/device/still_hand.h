// A hand with a constant target, for tests.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/device/hand.h"

namespace gearshift::test {

class StillHand final : public haptics::HandDriver {
 public:
  StillHand() = default;
  explicit StillHand(const haptics::HandTarget& wanted) : target(wanted) {}
  haptics::HandTarget next(double, glm::dvec2) noexcept override { return target; }

  haptics::HandTarget target;
};

inline haptics::HandTarget hand_at(glm::dvec2 position) {
  haptics::HandTarget target;
  target.position = position;
  return target;
}

inline haptics::HandTarget hand_pushing(glm::dvec2 push) {
  haptics::HandTarget target;
  target.push = push;
  return target;
}

}  // namespace gearshift::test
