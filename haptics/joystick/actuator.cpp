#include "haptics/joystick/actuator.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {

double Actuator::deliver(double commanded, double period) noexcept {
  const double limit = is_overloaded_ ? limits_.continuous_force : limits_.peak_force;
  const double force = std::isfinite(commanded) ? std::clamp(commanded, -limit, limit) : 0.0;

  const double continuous_squared = limits_.continuous_force * limits_.continuous_force;
  const double budget = (limits_.peak_force * limits_.peak_force - continuous_squared) * limits_.overload_time;
  heat_ = std::max(0.0, heat_ + (force * force - continuous_squared) * period);
  if (heat_ > budget) is_overloaded_ = true;
  if (is_overloaded_ && heat_ <= 0.5 * budget) is_overloaded_ = false;
  return force;
}

}  // namespace gearshift::haptics
