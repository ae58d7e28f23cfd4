// Sticks and wheels as people own them: a family's reports with the habits of its firmware.
#pragma once

#include <span>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

struct StickProfile {
  const char* name;
  StickFamily family;
  StickHabits habits;
  glm::ivec2 constant_sign{1, 1};  // of constant forces, where the firmware's own springs pull to their centre
};

std::span<const StickProfile> stick_profiles();
EmulatedStickConfig config_of(const StickProfile& profile);

}  // namespace gearshift::test
