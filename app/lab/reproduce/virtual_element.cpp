#include "app/lab/reproduce/virtual_element.h"

#include <cmath>

#include "haptics/joystick/plane_pose.h"

namespace gearshift::lab {

using glm::dvec2;

VirtualElement::VirtualElement(const haptics::AxisModel& x, const haptics::AxisModel& y, dvec2 rest,
                               std::optional<haptics::YokeGeometry> joints) noexcept
    : element_{x, y}, joints_(joints), rest_(coordinates(rest)) {}

dvec2 VirtualElement::coordinates(dvec2 plane) const noexcept {
  return joints_ ? haptics::arc_position(*joints_, haptics::joint_angles_from_plane(*joints_, plane)) : plane;
}

dvec2 VirtualElement::plane_force_of(dvec2 force, dvec2 plane) const noexcept {
  if (!joints_) return force;
  const haptics::JointAngles q = haptics::joint_angles_from_plane(*joints_, plane);
  return haptics::plane_force(haptics::plane_pose(std::tan(q.theta), std::tan(q.phi)), force);
}

// In the first call the period is 0, because nothing has moved yet.
haptics::LeverOutput VirtualElement::step(const haptics::LeverInput& in, double period) noexcept {
  const dvec2 position = coordinates(in.position);
  const dvec2 step = period > 0.0 ? position - position_ : dvec2(0.0);
  const dvec2 velocity = period > 0.0 ? step / period : dvec2(0.0);
  const dvec2 acceleration = period > 0.0 ? (step - step_) / (period * period) : dvec2(0.0);
  position_ = position;
  step_ = step;

  dvec2 force(0.0);
  for (int i = 0; i < 2; ++i) {
    const haptics::AxisModel& element = element_[static_cast<std::size_t>(i)];
    force[i] =
        -element.stiffness * (position[i] - rest_[i]) - element.damping * velocity[i] - element.mass * acceleration[i];
  }
  haptics::LeverOutput out;
  out.force = plane_force_of(force, in.position);
  return out;
}

}  // namespace gearshift::lab
