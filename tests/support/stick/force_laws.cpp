// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
// and on the firmware named in stick_habits.h.
#include "tests/support/stick/force_laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gearshift::test {
namespace {

constexpr std::uint8_t kX = 1, kY = 2, kDirection = 4;

bool has_x_bit(const EffectSettings& settings) noexcept {
  return (settings.axes & kX) != 0;
}
bool has_y_bit(const EffectSettings& settings) noexcept {
  return (settings.axes & kY) != 0;
}
bool has_direction_bit(const EffectSettings& settings) noexcept {
  return (settings.axes & kDirection) != 0;
}

// The encoded direction states where the force comes from, clockwise from the far side (PID 1.0 section 4.2): a force
// from the right (90 degrees) pushes left, a force from the far side (0 degrees) pushes towards the user.
glm::dvec2 away_from(double x_angle, double y_angle) noexcept {
  return {-std::sin(x_angle), std::cos(y_angle)};
}

// Without the direction bit, the two fields are the components of the force. The count for 180 degrees then means
// zero; X values below it push right, Y values above it push towards the user.
glm::dvec2 cartesian(const EffectSettings& settings) noexcept {
  constexpr double kPi = std::numbers::pi;
  return {has_x_bit(settings) ? 1.0 - settings.angle[0] / kPi : 0.0,
          has_y_bit(settings) ? settings.angle[1] / kPi - 1.0 : 0.0};
}

glm::dvec2 push_direction(const EffectSettings& settings, ConstantLaw law) noexcept {
  const double a0 = settings.angle[0], a1 = settings.angle[1];
  switch (law) {
    case ConstantLaw::first_angle:
      return away_from(a0, a0);
    case ConstantLaw::equal_to_4:
      return settings.axes == kDirection ? away_from(a0, a0) : away_from(a0, a1);
    case ConstantLaw::x_only:
      return {-1.0, 0.0};
    case ConstantLaw::no_bit_alone:
      return away_from(a0, a0) * glm::dvec2(has_x_bit(settings), has_y_bit(settings));
    default:
      return has_direction_bit(settings) ? away_from(a0, a0) : cartesian(settings);
  }
}

bool makes_force(const AxisCondition& condition) noexcept {
  return (condition.positive != 0.0 && condition.positive_saturation > 0.0) ||
         (condition.negative != 0.0 && condition.negative_saturation > 0.0);
}

}  // namespace

double condition_force(const AxisCondition& condition, double deflection, double slope, DeadBandLaw law) noexcept {
  double low = condition.centre - condition.dead_band, high = condition.centre + condition.dead_band;
  double below = low, above = high;  // where the force of each side is zero
  if (law == DeadBandLaw::narrow || law == DeadBandLaw::wide) {
    const double factor = law == DeadBandLaw::narrow ? 0.6 : 1.6;
    low = below = condition.centre - factor * condition.dead_band;
    high = above = condition.centre + factor * condition.dead_band;
  }
  if (law == DeadBandLaw::ignored) low = high = below = above = condition.centre;
  if (law == DeadBandLaw::raw_counts) {
    low = condition.centre_counts - condition.dead_band_counts;
    high = condition.centre_counts + condition.dead_band_counts;
  }
  if (law == DeadBandLaw::shifts_centre) {
    const bool is_inside = deflection > low && deflection < high;
    const double force =
        is_inside ? condition.negative * slope * (deflection - low) : condition.positive * slope * (deflection - high);
    return -std::clamp(force, -condition.negative_saturation, condition.positive_saturation);
  }
  if (deflection > high)
    return -std::clamp(condition.positive * slope * (deflection - above), -condition.positive_saturation,
                       condition.positive_saturation);
  if (deflection < low)
    return -std::clamp(condition.negative * slope * (deflection - below), -condition.negative_saturation,
                       condition.negative_saturation);
  return 0.0;
}

namespace {

// adapt 0.4: int16_t v = value; (((v * gain) / 256) >> 2) & 0x7f, with the int of 16 bits of an AVR
double strength_with_jump(double magnitude, double gain) noexcept {
  const auto product = static_cast<std::int16_t>(std::lround(255.0 * std::abs(magnitude)) * std::lround(255.0 * gain));
  const double strength = static_cast<double>(((product / 256) >> 2) & 0x7f) / 127.0;
  return magnitude < 0.0 ? -strength : strength;
}

}  // namespace

void add_constant(const DeviceEffect& effect, const StickHabits& habits, glm::dvec2& sum) noexcept {
  const EffectSettings& settings = effect.settings;
  const double gain = habits.constant_ignores_gain ? (settings.gain > 0.0 ? 1.0 : 0.0) : settings.gain;
  const double magnitude = effect.sign_dropped ? std::abs(effect.magnitude) : effect.magnitude;
  const double force = habits.jumps_at_half ? strength_with_jump(magnitude, gain) : gain * magnitude;
  if (habits.constant != ConstantLaw::rotates_sum) {
    sum += force * push_direction(settings, habits.constant);
    return;
  }
  sum.x -= force;
  if (!has_direction_bit(settings)) return;
  sum.y += sum.x * std::cos(settings.angle[0]);
  sum.x *= std::sin(settings.angle[0]);
}

glm::dvec2 condition_forces(const DeviceEffect& effect, const StickHabits& habits, glm::dvec2 deflection,
                            double slope) noexcept {
  const EffectSettings& settings = effect.settings;
  const auto& condition = effect.condition;
  const auto of = [&](std::size_t block, int axis) {
    return condition[block].is_set
               ? settings.gain * condition_force(condition[block], deflection[axis], slope, habits.dead_band)
               : 0.0;
  };
  const glm::dvec2 own{of(0, 0), of(1, 1)}, first{of(0, 0), of(0, 1)};
  const glm::dvec2 direction{std::sin(settings.angle[0]), -std::cos(settings.angle[0])};
  const bool has_two = condition[1].is_set;
  switch (habits.condition) {
    case ConditionLaw::per_axis: {
      const bool both = has_direction_bit(settings);
      return {both || has_x_bit(settings) ? own.x : 0.0, both || has_y_bit(settings) ? own.y : 0.0};
    }
    case ConditionLaw::board:
      return effect.factor * (effect.is_single ? first : own);
    case ConditionLaw::counted:
      if (settings.axes != kDirection || effect.condition_reports > 1) return own;
      return effect.condition_reports == 1 ? first * direction : first;
    case ConditionLaw::exactly_4:
      if (has_two) return settings.axes == kDirection ? own : first * -direction;
      return direction * of(0, 0) * direction.x;
    case ConditionLaw::both_axes:
      return has_direction_bit(settings) || has_two ? own : first;
    case ConditionLaw::x_only:
      return {own.x, 0.0};
    case ConditionLaw::along_direction: {
      if (!has_direction_bit(settings)) return {has_x_bit(settings) ? own.x : 0.0, has_y_bit(settings) ? own.y : 0.0};
      const double along = deflection.x * direction.x + deflection.y * direction.y;
      return condition[0].is_set ? settings.gain * condition_force(condition[0], along, slope) * direction
                                 : glm::dvec2(0.0);
    }
    case ConditionLaw::times_direction:
      if (has_direction_bit(settings) && has_two) return own;
      return has_direction_bit(settings) ? direction * of(0, 0) * direction.x : own * -direction;
    case ConditionLaw::direction_scales:
      return own * direction;
    case ConditionLaw::last_set:
      return effect.last_set == 0 ? glm::dvec2(own.x, 0.0) : glm::dvec2(0.0, own.y);
    case ConditionLaw::never:
      break;
  }
  return glm::dvec2(0.0);
}

// While a single condition serves both axes, its force is multiplied by the direction, sign included.
void on_effect_set(DeviceEffect& effect) noexcept {
  const EffectSettings& settings = effect.settings;
  if (!effect.is_single && (makes_force(effect.condition[0]) || makes_force(effect.condition[1]))) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (makes_force(effect.condition[i])) effect.factor[static_cast<int>(i)] = 1.0;
    }
    return;
  }
  effect.factor = has_direction_bit(settings) ? -away_from(settings.angle[0], settings.angle[0]) : -cartesian(settings);
}

void on_condition_told(DeviceEffect& effect, std::size_t axis) noexcept {
  ++effect.condition_reports;
  effect.last_set = static_cast<int>(axis);
  if (!makes_force(effect.condition[axis])) return;
  if (axis == 1) effect.is_single = false;
  double& factor = effect.factor[static_cast<int>(axis)];
  if (factor == 0.0) factor = 1.0;
}

}  // namespace gearshift::test
