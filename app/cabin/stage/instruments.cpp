#include "app/cabin/stage/instruments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"

namespace gearshift::cabin {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kPedalTravel = 20.0 * kDegree;
constexpr double kHandBrakeTravel = 30.0 * kDegree;
constexpr double kIdleLimit = 300.0;  // [1/min] oil, battery and engine lamps are lit below this engine speed

bool is_lit(Lamp lamp, const vehicle::VehicleState& car, const haptics::HapticSnapshot& lever) noexcept {
  const double rpm = car.engine_speed / haptics::kTurnPerMinute;
  switch (lamp) {
    case Lamp::oil:
    case Lamp::battery:
      return car.ignition && rpm < kIdleLimit;
    case Lamp::hand_brake:
      return car.ignition && car.pedals.hand_brake > 0.05;
    case Lamp::engine:
      return car.ignition && (car.over_revved || !car.running || rpm < kIdleLimit);
    case Lamp::stall:
      return car.ignition && (car.stalled || car.grinding);
    case Lamp::turn_left:
    case Lamp::turn_right:
      return false;  // the road has no turns
    case Lamp::lever:
      return (lever.flags & (haptics::kFlagOverPush | haptics::kFlagSaturated)) != 0;
  }
  return false;
}

// The scale with the fewest numbers, at most 13 of them besides 0, that is at least `least` long. The numbers are 1, 2 or 5
// times a power of ten apart, as on real dials.
DialScale scale_beyond(double least, double step) {
  for (int i = 0; least > 13.0 * step; ++i) step *= i % 3 == 1 ? 2.5 : 2.0;
  return {step * std::ceil(least / step), step};
}

}  // namespace

DialScale tach_scale(double red_line) noexcept {
  DialScale scale{8000.0, 1000.0};
  if (red_line > 0.0) {
    const double least = 1.1 * red_line / haptics::kTurnPerMinute;
    scale = scale_beyond(least, least > 4000.0 ? 1000.0 : 500.0);
  }
  scale.ticks = 4;
  return scale;
}

DialScale speed_scale(double top_speed, vehicle::SpeedUnit unit) noexcept {
  if (!(top_speed > 0.0)) return {220.0, 20.0};
  return scale_beyond(8.0 / 7.0 * vehicle::in_unit(unit, top_speed), 10.0);
}

double needle_angle(double value, double top) noexcept {
  return kDegree * (135.0 - 270.0 * std::clamp(value / top, 0.0, 1.0));
}

double tach_angle(const vehicle::VehicleState& car) noexcept {
  return needle_angle(car.engine_speed / haptics::kTurnPerMinute, tach_scale(car.red_line).top);
}

double speed_angle(const vehicle::VehicleState& car) noexcept {
  return needle_angle(vehicle::in_unit(car.speed_unit, std::abs(car.road_speed)),
                      speed_scale(car.top_speed, car.speed_unit).top);
}

double vibration(const vehicle::VehicleState& car, double time) noexcept {
  if (!(car.shudder > 0.0)) return 0.0;
  const double turn = 2.0 * std::numbers::pi * time;
  return std::min(car.shudder, 1.0) * (0.6 * std::sin(13.0 * turn) + 0.4 * std::sin(17.0 * turn));
}

glm::vec2 gear_field(int gear) noexcept {
  constexpr float kField = 176.0f / 2048.0f;  // [1] width of a field relative to the atlas (assets/models/README.md)
  return {kField * static_cast<float>(std::clamp(gear, haptics::kReverseGear, haptics::kMaxGear)), 0.0f};
}

double pedal_angle(double pressed) noexcept {
  return kPedalTravel * std::clamp(pressed, 0.0, 1.0);
}

double hand_brake_angle(double pulled) noexcept {
  return kHandBrakeTravel * std::clamp(pulled, 0.0, 1.0);
}

float lamp_light(Lamp lamp, const vehicle::VehicleState& car, const haptics::HapticSnapshot& lever) noexcept {
  return is_lit(lamp, car, lever) ? 1.0f : 0.0f;
}

}  // namespace gearshift::cabin
