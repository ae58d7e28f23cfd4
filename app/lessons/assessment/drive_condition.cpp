#include "app/lessons/assessment/drive_condition.h"

namespace gearshift::lessons {
namespace {

// [1] Positions of brake pedal and handbrake above which the brakes hold the car. Engineering values.
constexpr double kMinHoldingBrake = 0.05, kMinHoldingHandBrake = 0.5;

bool matches(const std::optional<bool>& wanted, bool actual) noexcept {
  return !wanted || *wanted == actual;
}

bool is_between(const std::optional<double>& above, const std::optional<double>& below, double value) noexcept {
  return !(above && value <= *above) && !(below && value >= *below);
}

}  // namespace

bool holds(const DriveCondition& c, const vehicle::DriveSample& sample, const DriveProgress& progress) noexcept {
  const vehicle::VehicleState& car = sample.car;
  return (!c.gear || *c.gear == car.gear) && matches(c.ignition, car.ignition) && matches(c.running, car.running) &&
         matches(c.cranking, car.cranking) && matches(c.clutch_locked, car.clutch_locked) &&
         matches(c.shift_light, car.shift_advice > 0) &&
         matches(c.braked, car.pedals.brake > kMinHoldingBrake || car.pedals.hand_brake > kMinHoldingHandBrake) &&
         is_between(c.clutch_above, c.clutch_below, car.pedals.clutch) &&
         is_between(c.clutch_torque_above, {}, car.clutch_torque) &&
         is_between(c.throttle_above, c.throttle_below, car.pedals.throttle) &&
         is_between(c.brake_above, c.brake_below, car.pedals.brake) &&
         is_between(c.hand_brake_above, c.hand_brake_below, car.pedals.hand_brake) &&
         is_between(c.engine_above, c.engine_below, car.engine_speed) &&
         is_between(c.speed_above, c.speed_below, car.road_speed) &&
         is_between(c.distance_above, {}, progress.distance) &&
         is_between(c.rolled_back_above, {}, progress.rolled_back);
}

bool is_empty(const DriveCondition& condition) noexcept {
  bool empty = !condition.gear;
  haptics::each_parameter(condition, [&](const auto&, const auto& term) {
    if constexpr (requires { term.has_value(); }) empty = empty && !term.has_value();
  });
  return empty;
}

bool HeldCondition::update(const DriveCondition& condition, const vehicle::DriveSample& sample,
                           const DriveProgress& progress) noexcept {
  const bool on = holds(condition, sample, progress);
  if (on && !on_) since_ = sample.time();
  on_ = on;
  if (first_) began_false_ = !on;
  first_ = false;
  return on && sample.time() - since_ >= condition.held;
}

}  // namespace gearshift::lessons
