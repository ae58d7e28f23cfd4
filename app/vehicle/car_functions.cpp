// Curves and ratios derived from a car's data.
#include <algorithm>
#include <cmath>

#include "app/vehicle/car_spec.h"

namespace gearshift::vehicle {
namespace {
// A compressed cylinder pushes back what it took, except for the gas that leaks meanwhile. So compression resists only
// an engine that hardly turns. No source found for the speed: engineering value.
constexpr double kCompressionSpeed = 4.0;  // [rad/s] at which a fraction 1/e is left
}  // namespace

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

double top_speed(const CarSpec& car) noexcept {
  const BodySpec& body = car.body;
  double top = 0.0;
  for (int gear = 1; gear <= haptics::kMaxGear; ++gear) {
    const double per_road = shaft_per_road(car, gear);
    if (per_road == 0.0) break;
    const auto is_kept = [&](double speed) {
      const double drive = full_torque(car.engine, per_road * speed) * per_road * car.gearbox.efficiency;
      return drive >= body.resistance + (body.resistance_slope + body.resistance_square * speed) * speed;
    };
    double low = top, high = car.engine.limiter / per_road;
    if (is_kept(high)) low = high;
    // At the highest kept speed, more speed means less drive and more resistance.
    while (high - low > 0.01) (is_kept(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    top = std::max(top, low);
  }
  return top;
}

double friction_torque(const EngineSpec& engine, double speed) noexcept {
  const double turning = std::abs(speed);
  const double friction = engine.friction + (engine.friction_slope + engine.friction_square * turning) * turning;
  if (turning > kMaxCompressedSpeed) return friction;
  return friction + engine.compression * std::exp(-turning / kCompressionSpeed);
}

}  // namespace gearshift::vehicle
