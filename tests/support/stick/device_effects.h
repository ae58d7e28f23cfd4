// The effects in a stick's memory: their blocks, when they play, and their forces. Forces and deflections are
// fractions: 1 is the full force of the device, or the full deflection of an axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "tests/support/stick/stick_habits.h"

namespace gearshift::test {

// Silent effects are accepted, but make no force.
enum class EffectKind : std::uint8_t { silent, constant, spring, damper };

struct AxisCondition {
  bool is_set = false;
  double centre = 0.0, dead_band = 0.0;
  double centre_counts = 0.0, dead_band_counts = 0.0;           // as commanded
  double positive = 0.0, negative = 0.0;                        // coefficients on the two sides of the centre
  double positive_saturation = 0.0, negative_saturation = 0.0;  // 0 to 1
};

struct EffectSettings {
  bool is_set = false;
  EffectKind kind = EffectKind::silent;
  std::int64_t duration_ns = 0;  // 0: endless
  std::int64_t delay_ns = 0;     // delay of the force after the start command
  double gain = 1.0;
  std::uint8_t axes = 0;          // bit 0: X, bit 1: Y, bit 2: the direction counts
  glm::dvec2 angle{0.0};          // [rad] the two direction fields
  bool waits_for_button = false;  // plays only while a button is pressed; no button ever is
};

struct DeviceEffect {
  bool in_use = false;
  EffectSettings settings;
  double magnitude = 0.0;
  std::array<int, 2> place{};  // of the parameters, if the driver manages the pool
  bool sign_dropped = false;   // StickHabits::drops_sign
  std::array<AxisCondition, 2> condition{};
  std::uint8_t condition_reports = 0;  // ConditionLaw::counted
  int last_set = 0;                    // ConditionLaw::last_set: axis
  bool is_single = true;               // ConditionLaw::board
  glm::dvec2 factor{0.0};              // ConditionLaw::board
  bool playing = false;
  std::int64_t start_ns = 0, end_ns = 0;  // times at which the force begins and ends; end_ns 0: no end
};

struct EffectForces {
  glm::dvec2 constant{0.0}, spring{0.0}, damper{0.0};
  glm::dvec2 centring{0.0};  // of the stick itself
};

// Motion of the lever, from which conditions compute their forces.
struct DeviceMotion {
  glm::dvec2 deflection{0.0}, speed{0.0};
  double spring_slope = 1.0;  // spring force at full deflection with the maximum coefficient
};

class DeviceEffects {
 public:
  explicit DeviceEffects(int blocks) : effects_(static_cast<std::size_t>(blocks)) {}  // blocks are numbered from 1

  int create() noexcept;  // returns the lowest free block, 0 if there is none
  // As create(), but a block that has been started and stopped counts as free.
  int create_or_take_stopped() noexcept;
  void take(int block) noexcept;  // uses the block, if it is free
  void free(int block) noexcept;
  void free_all() noexcept;
  DeviceEffect* find(int block) noexcept;  // nullptr if the block is not in use
  const DeviceEffect* find(int block) const noexcept;
  int free_blocks() const noexcept;

  // With `loops` = 255, the effect is endless. An effect that is already playing starts again.
  void start(DeviceEffect& effect, int loops, std::int64_t now_ns) noexcept;
  void stop_all() noexcept;
  void stop_oldest() noexcept;  // of the effects that play, that which was started first
  void forget_all() noexcept;   // blocks stay in use, but without settings
  // Ends the effects whose time is over and returns the numbers of their blocks.
  std::vector<int> expire(std::int64_t now_ns);
  // Delays the start and the end of all playing effects by `by_ns`, the duration of a pause.
  void postpone(std::int64_t by_ns) noexcept;
  int playing() const noexcept;
  bool plays(EffectKind kind) const noexcept;

  EffectForces forces(const DeviceMotion& motion, const StickHabits& habits, std::int64_t now_ns) const noexcept;

 private:
  std::vector<DeviceEffect> effects_;  // indexed by block - 1
};

}  // namespace gearshift::test
