// What the paper lets the joystick emulate: spring, damper, mass or all three, eq (19), on each axis its own.
#pragma once

#include <array>
#include <optional>

#include "haptics/joystick/kinematics.h"
#include "haptics/joystick/plant.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

// E(z) = K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2: backward differences of the samples, no filter.
class VirtualElement final : public LeverWorld {
 public:
  // rest [m] in the gate plane: where the springs are relaxed. All zeros are no element. The elements act in the
  // gate plane; with a yoke on its joints, each by itself, as the paper's do with (3) and (6).
  VirtualElement(const AxisModel& x, const AxisModel& y, glm::dvec2 rest, std::optional<YokeGeometry> joints) noexcept;

  LeverOutput step(const LeverInput& in, double period) noexcept override;
  const char* name() const noexcept override { return "virtual element"; }

 private:
  glm::dvec2 coordinates(glm::dvec2 plane) const noexcept;
  glm::dvec2 plane_force_of(glm::dvec2 force, glm::dvec2 plane) const noexcept;

  std::array<AxisModel, 2> element_;
  std::optional<YokeGeometry> joints_;
  glm::dvec2 rest_;           // [m] in its coordinates, like what follows
  glm::dvec2 position_{0.0};  // of the last sample
  glm::dvec2 step_{0.0};      // that it came by
};

}  // namespace gearshift
