// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
#include "tests/support/stick/device_effects.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearshift::test {
namespace {

constexpr int kEndlessLoops = 255;

glm::dvec2 condition_forces(const DeviceEffect& effect, glm::dvec2 deflection, double slope) noexcept {
  glm::dvec2 force{0.0};
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (!effect.settings.axis[i] || !effect.condition[i].is_set) continue;
    force[axis] = effect.settings.gain * condition_force(effect.condition[i], deflection[axis], slope);
  }
  return force;
}

}  // namespace

double condition_force(const AxisCondition& condition, double deflection, double slope) noexcept {
  const double offset = deflection - condition.centre;
  const double excess = std::abs(offset) - condition.dead_band;
  if (excess <= 0.0) return 0.0;
  const double coefficient = offset > 0.0 ? condition.positive : condition.negative;
  const double limit = offset > 0.0 ? condition.positive_saturation : condition.negative_saturation;
  const double force = std::clamp(coefficient * slope * excess, -limit, limit);
  return offset > 0.0 ? -force : force;
}

int DeviceEffects::create() noexcept {
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    if (effects_[i].in_use) continue;
    effects_[i] = {};
    effects_[i].in_use = true;
    return static_cast<int>(i) + 1;
  }
  return 0;
}

void DeviceEffects::free(int block) noexcept {
  if (DeviceEffect* effect = find(block)) *effect = {};
}

void DeviceEffects::free_all() noexcept {
  std::fill(effects_.begin(), effects_.end(), DeviceEffect{});
}

const DeviceEffect* DeviceEffects::find(int block) const noexcept {
  if (block < 1 || block > static_cast<int>(effects_.size())) return nullptr;
  const DeviceEffect& effect = effects_[static_cast<std::size_t>(block - 1)];
  return effect.in_use ? &effect : nullptr;
}

DeviceEffect* DeviceEffects::find(int block) noexcept {
  return const_cast<DeviceEffect*>(std::as_const(*this).find(block));
}

int DeviceEffects::free_blocks() const noexcept {
  return static_cast<int>(std::count_if(effects_.begin(), effects_.end(), [](const auto& e) { return !e.in_use; }));
}

void DeviceEffects::start(DeviceEffect& effect, int loops, std::int64_t now_ns) noexcept {
  const EffectSettings& settings = effect.settings;
  if (!settings.is_set) return;
  effect.playing = true;
  effect.start_ns = now_ns + settings.delay_ns;
  const bool is_finite = settings.duration_ns > 0 && loops < kEndlessLoops;
  effect.end_ns = is_finite ? effect.start_ns + std::max(loops, 1) * settings.duration_ns : 0;
}

void DeviceEffects::stop_all() noexcept {
  for (DeviceEffect& effect : effects_) effect.playing = false;
}

std::vector<int> DeviceEffects::expire(std::int64_t now_ns) {
  std::vector<int> ended;
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    DeviceEffect& effect = effects_[i];
    if (!effect.playing || effect.end_ns == 0 || now_ns < effect.end_ns) continue;
    effect.playing = false;
    ended.push_back(static_cast<int>(i) + 1);
  }
  return ended;
}

void DeviceEffects::postpone(std::int64_t by_ns) noexcept {
  for (DeviceEffect& effect : effects_) {
    if (!effect.playing) continue;
    effect.start_ns += by_ns;
    if (effect.end_ns != 0) effect.end_ns += by_ns;
  }
}

int DeviceEffects::playing() const noexcept {
  return static_cast<int>(std::count_if(effects_.begin(), effects_.end(), [](const auto& e) { return e.playing; }));
}

EffectForces DeviceEffects::forces(const DeviceMotion& motion, std::int64_t now_ns) const noexcept {
  EffectForces forces;
  for (const DeviceEffect& effect : effects_) {
    if (!effect.playing || now_ns < effect.start_ns) continue;
    const EffectSettings& settings = effect.settings;
    if (settings.kind == EffectKind::constant) {
      forces.constant += settings.gain * effect.magnitude * settings.direction;
    } else if (settings.kind == EffectKind::spring) {
      forces.spring += condition_forces(effect, motion.deflection, motion.spring_slope);
    } else if (settings.kind == EffectKind::damper) {
      forces.damper += condition_forces(effect, motion.speed, 1.0);
    }
  }
  return forces;
}

}  // namespace gearshift::test
