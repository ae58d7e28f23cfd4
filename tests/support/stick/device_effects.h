// The effects in a stick's memory: its blocks, when they play, and what they push. In shares, as the device counts: 1 is
// the full force, and the full deflection of an axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift {

enum class EffectKind : std::uint8_t { silent, constant, spring, damper };  // silent: it is told, but pushes nothing

struct AxisCondition {
  bool given = false;
  double centre = 0.0, dead_band = 0.0;
  double positive = 0.0, negative = 0.0;                        // coefficients, on either side
  double positive_saturation = 0.0, negative_saturation = 0.0;  // 0 to 1
};

struct EffectSettings {
  bool given = false;
  EffectKind kind = EffectKind::silent;
  std::int64_t duration_ns = 0;  // 0: for ever
  std::int64_t delay_ns = 0;     // from start to force
  double gain = 1.0;
  glm::dvec2 direction{0.0};               // of a constant force, where a positive magnitude pushes
  std::array<bool, 2> axis{false, false};  // on which a condition acts
};

struct DeviceEffect {
  bool taken = false;
  EffectSettings settings;
  double magnitude = 0.0;
  std::array<AxisCondition, 2> condition{};
  bool playing = false;
  std::int64_t start_ns = 0, end_ns = 0;  // of the force; end 0: for ever
};

struct EffectForces {
  glm::dvec2 constant{0.0}, spring{0.0}, damper{0.0};
};

// What an axis says of itself, for conditions.
struct DeviceMotion {
  glm::dvec2 deflection{0.0}, speed{0.0};
  double spring_slope = 1.0;  // force of the greatest coefficient at full deflection
};

class DeviceEffects {
 public:
  explicit DeviceEffects(int blocks) : effects_(static_cast<std::size_t>(blocks)) {}  // numbered from 1

  int create() noexcept;  // the lowest free block; 0: there is none
  void free(int block) noexcept;
  void free_all() noexcept;
  DeviceEffect* find(int block) noexcept;  // nullptr: not taken
  const DeviceEffect* find(int block) const noexcept;
  int free_blocks() const noexcept;

  void start(DeviceEffect& effect, int loops, std::int64_t now_ns) noexcept;  // loops 255: for ever; anew if it plays
  void stop_all() noexcept;
  // Ends those whose time is over; their blocks.
  std::vector<int> expire(std::int64_t now_ns);
  // Time passes that does not count: a pause.
  void postpone(std::int64_t by_ns) noexcept;
  int playing() const noexcept;

  EffectForces forces(const DeviceMotion& motion, std::int64_t now_ns) const noexcept;

 private:
  std::vector<DeviceEffect> effects_;  // by block
};

// Towards the centre, from the edge of the dead band on; slope: force of coefficient 1 at deflection 1.
double condition_force(const AxisCondition& condition, double deflection, double slope) noexcept;

}  // namespace gearshift
