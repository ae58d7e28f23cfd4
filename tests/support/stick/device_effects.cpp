// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
#include "tests/support/stick/device_effects.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/stick/force_laws.h"

namespace gearshift::test {
namespace {

constexpr int kEndlessLoops = 255;
constexpr double kSpringLike = 4.0;  // [1] speed that a deflection of 1 is taken for, with DamperLaw::is_spring

// The lever's speed as the firmware computes it.
glm::dvec2 damper_input(const DeviceMotion& motion, DamperLaw law) noexcept {
  constexpr double kInfinity = 1e9, kStill = 1e-4;
  const auto full = [](double speed) { return std::abs(speed) < kStill ? 0.0 : std::copysign(kInfinity, speed); };
  switch (law) {
    case DamperLaw::nothing:
      return glm::dvec2(0.0);
    case DamperLaw::full:
      return {full(motion.speed.x), full(motion.speed.y)};
    case DamperLaw::is_spring:
      return kSpringLike * motion.deflection;
    case DamperLaw::brakes:
      break;
  }
  return motion.speed;
}

}  // namespace

int DeviceEffects::create() noexcept {
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    if (effects_[i].in_use) continue;
    effects_[i] = {};
    effects_[i].in_use = true;
    return static_cast<int>(i) + 1;
  }
  return 0;
}

int DeviceEffects::create_or_take_stopped() noexcept {
  for (DeviceEffect& effect : effects_) {
    if (effect.in_use && !effect.playing && effect.start_ns > 0) effect = {};
  }
  return create();
}

void DeviceEffects::take(int block) noexcept {
  if (block < 1 || block > static_cast<int>(effects_.size())) return;
  effects_[static_cast<std::size_t>(block - 1)].in_use = true;
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

void DeviceEffects::stop_oldest() noexcept {
  DeviceEffect* oldest = nullptr;
  for (DeviceEffect& effect : effects_) {
    if (effect.playing && (oldest == nullptr || effect.start_ns < oldest->start_ns)) oldest = &effect;
  }
  if (oldest != nullptr) oldest->playing = false;
}

void DeviceEffects::forget_all() noexcept {
  for (DeviceEffect& effect : effects_) {
    const bool in_use = effect.in_use;
    effect = {};
    effect.in_use = in_use;
  }
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

bool DeviceEffects::plays(EffectKind kind) const noexcept {
  return std::any_of(effects_.begin(), effects_.end(),
                     [kind](const DeviceEffect& e) { return e.playing && e.settings.kind == kind; });
}

EffectForces DeviceEffects::forces(const DeviceMotion& motion, const StickHabits& habits,
                                   std::int64_t now_ns) const noexcept {
  const auto gap_ns = static_cast<std::int64_t>(1e9 * habits.restart_gap);
  EffectForces forces;
  for (const DeviceEffect& effect : effects_) {
    if (!effect.playing || effect.settings.waits_for_button || now_ns < effect.start_ns + gap_ns) continue;
    if (effect.settings.kind == EffectKind::constant) {
      add_constant(effect, habits, forces.constant);
    } else if (effect.settings.kind == EffectKind::spring) {
      forces.spring += condition_forces(effect, habits, motion.deflection, motion.spring_slope);
    } else if (effect.settings.kind == EffectKind::damper) {
      forces.damper += condition_forces(effect, habits, damper_input(motion, habits.damper), 1.0);
    }
  }
  return forces;
}

}  // namespace gearshift::test
