// Curves and ratios derived from a car's data.
#include <algorithm>

#include "app/vehicle/car_spec.h"

namespace gearshift::vehicle {

double shaft_per_road(const CarSpec& car, int gear) noexcept {
  const GearboxSpec& box = car.gearbox;
  double ratio = 0.0;
  if (gear == haptics::kReverseGear) ratio = -box.reverse;
  if (gear >= 1 && gear <= haptics::kMaxGear) ratio = box.ratio[static_cast<std::size_t>(gear - 1)];
  return ratio * box.final_drive / car.body.wheel_radius;
}

double full_torque(const EngineSpec& engine, double speed) noexcept {
  const auto& point = engine.full_load;
  if (engine.points == 0 || !(speed >= point[0].speed) || speed > point[engine.points - 1].speed) return 0.0;
  for (std::size_t i = 1; i < engine.points; ++i) {
    if (speed > point[i].speed) continue;
    const double fraction = (speed - point[i - 1].speed) / (point[i].speed - point[i - 1].speed);
    return point[i - 1].torque + fraction * (point[i].torque - point[i - 1].torque);
  }
  return point[engine.points - 1].torque;  // reached only if the table has a single point
}

double friction_torque(const EngineSpec& engine, double speed) noexcept {
  return engine.friction + (engine.friction_slope + engine.friction_square * speed) * speed;
}

}  // namespace gearshift::vehicle
