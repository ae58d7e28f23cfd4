// The elements that the paper's joystick emulates with eq (19): a spring, a damper, a mass or a combination. The axes
// are independent.
#pragma once

#include <array>
#include <optional>

#include "haptics/joystick/kinematics.h"
#include "haptics/joystick/plant.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::lab {

// The transfer function from displacement to resisting force is E(z) = K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2 with
// stiffness K, damping B, mass M and period T. Velocity and acceleration are backward differences of the samples,
// without a filter.
class VirtualElement final : public haptics::LeverLoad {
 public:
  // `rest`: position in the gate plane at which the springs are relaxed [m]. A model of all zeros means no element.
  // `joints`: if a yoke is given, the elements act on each joint separately, as with the paper's equations (3) and (6).
  // Otherwise they act in the gate plane.
  VirtualElement(const haptics::AxisModel& x, const haptics::AxisModel& y, glm::dvec2 rest,
                 std::optional<haptics::YokeGeometry> joints) noexcept;

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  const char* replay_parameters() const noexcept override { return "virtual element"; }

 private:
  glm::dvec2 coordinates(glm::dvec2 plane) const noexcept;
  glm::dvec2 plane_force_of(glm::dvec2 force, glm::dvec2 plane) const noexcept;

  std::array<haptics::AxisModel, 2> element_;
  std::optional<haptics::YokeGeometry> joints_;
  glm::dvec2 rest_;           // [m] in the element's coordinates, as are position_ and step_
  glm::dvec2 position_{0.0};  // [m] position in the last sample
  glm::dvec2 step_{0.0};      // [m] displacement between the last two samples
};

}  // namespace gearshift::lab
