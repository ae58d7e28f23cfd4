// Position and velocity of the lever from encoder readings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift {

struct LeverMotion {
  glm::dvec2 position{0.0};  // [m] newest trusted sample
  glm::dvec2 velocity{0.0};  // [m/s] difference over the window; of the last two samples: no lag, noise of a count
  glm::dvec2 smooth_velocity{0.0};  // [m/s] low-passed, for damping in free space
  bool fresh = false;               // this cycle brought a new, finite, possible sample
};

inline constexpr int kMostWindow = 64;  // [samples]

struct EstimatorConfig {
  double smoothing = 0.004;   // [s] 1e-5 to 1, time constant of smooth_velocity
  double speed_limit = 10.0;  // [m/s] 0.1 to 1000, a faster jump is not believed
  int window = 1;             // [samples] 1 to 64, that `velocity` is the difference over; above 1 for study only
};

class LeverEstimator {
 public:
  // period [s]; count [m]: of the encoder at the tip, a jump by which says nothing of a speed; stale_time [s]: after
  // which the guard falls
  LeverEstimator(const EstimatorConfig& config, double period, double count = 0.0, double stale_time = 0.0) noexcept;

  // Motion after one reading. Not finite, jumping, backward or repeated readings are not fresh: position and
  // velocity are held. After 50 ms without a believed sample, and not before the guard has seen that for its stale
  // time and 30 ms more, the next finite one is a new start, whatever its place and number, with zero velocity.
  // Real-time safe.
  LeverMotion update(const LeverReading& reading) noexcept;

 private:
  double seconds(std::int64_t from_ns, std::int64_t to_ns) const noexcept;
  LeverMotion hold() noexcept;
  LeverMotion restart(const LeverReading& reading) noexcept;
  void accept(const LeverReading& reading, glm::dvec2 velocity) noexcept;
  void remember(const LeverReading& reading) noexcept;
  glm::dvec2 window_velocity(const LeverReading& reading, glm::dvec2 newest) const noexcept;

  EstimatorConfig config_;
  double period_;
  double edge_;        // [m] a count on both axes at once
  double lost_after_;  // [s]
  double blend_;       // [1] of the newest sample in smooth_velocity
  LeverMotion motion_;
  std::int64_t time_ns_ = 0;         // of the last believed sample
  std::uint64_t seen_sequence_ = 0;  // of the last one, believed or not
  std::int64_t seen_time_ns_ = 0;
  struct Sample {
    glm::dvec2 position{0.0};
    std::int64_t time_ns = 0;
  };
  std::array<Sample, kMostWindow> past_{};  // believed samples; used where the window is longer than one
  std::size_t past_count_ = 0;              // since the last start
  double unbelieved_ = 0.0;                 // [s] since the last believed sample
  bool started_ = false;
};

}  // namespace gearshift
