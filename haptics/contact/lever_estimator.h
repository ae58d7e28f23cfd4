// Position and velocity of the lever from encoder readings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift::haptics {

struct LeverMotion {
  glm::dvec2 position{0.0};  // [m] newest accepted sample
  glm::dvec2 velocity{0.0};  // [m/s] difference over the window; window 1: no lag, but one encoder count of noise
  glm::dvec2 smooth_velocity{0.0};  // [m/s] low-passed, for damping in free space
  bool fresh = false;               // this cycle's sample was new, finite and plausible
};

inline constexpr int kMaxWindow = 64;  // [samples]

struct EstimatorConfig {
  double smoothing = 0.004;   // [s] 1e-5 to 1, time constant of smooth_velocity
  double speed_limit = 10.0;  // [m/s] 0.1 to 1000, a faster jump is rejected
  int window = 1;             // [samples] 1 to 64, span of the difference in `velocity`; above 1 needs allow_unstable
};

class LeverEstimator {
 public:
  // period [s]; count [m]: one encoder count at the tip, a jump that is always accepted; stale_time [s]: the guard's
  // limit for stale readings
  LeverEstimator(const EstimatorConfig& config, double period, double count = 0.0, double stale_time = 0.0) noexcept;

  // Motion after one reading. A reading that is not finite, jumps, goes backward in time or repeats is not fresh:
  // position and velocity are held. After max(50 ms, stale_time + 30 ms) without an accepted sample the estimator
  // restarts at the next finite one with zero velocity, whatever its position and sequence number; by then the guard
  // has reacted to the stale readings. Real-time safe.
  LeverMotion update(const LeverReading& reading) noexcept;

 private:
  double seconds(std::int64_t from_ns, std::int64_t to_ns) const noexcept;
  LeverMotion hold() noexcept;
  LeverMotion restart(const LeverReading& reading) noexcept;
  void accept(const LeverReading& reading, glm::dvec2 velocity) noexcept;
  void store_sample(const LeverReading& reading) noexcept;
  glm::dvec2 window_velocity(const LeverReading& reading, glm::dvec2 newest) const noexcept;

  EstimatorConfig config_;
  double period_;
  double jump_tolerance_;  // [m] length of a jump of one count on both axes at once
  double restart_after_;   // [s]
  double blend_;           // [1] weight of the newest sample in smooth_velocity
  LeverMotion motion_;
  std::int64_t accepted_time_ns_ = 0;  // time of the last accepted sample
  std::uint64_t last_sequence_ = 0;    // sequence number of the last sample, accepted or not
  std::int64_t last_time_ns_ = 0;
  struct Sample {
    glm::dvec2 position{0.0};
    std::int64_t time_ns = 0;
  };
  std::array<Sample, kMaxWindow> history_{};  // accepted samples, kept only if the window is longer than one
  std::size_t history_count_ = 0;             // samples stored since the last start or restart
  double unaccepted_time_ = 0.0;              // [s] time since the last accepted sample
  bool started_ = false;
};

}  // namespace gearshift::haptics
