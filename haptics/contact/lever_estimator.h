// Position and velocity of the lever from encoder readings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"
#include "haptics/files/parameter.h"

namespace gearshift::haptics {

struct LeverMotion {
  glm::dvec2 position{0.0};         // [m] newest accepted sample
  glm::dvec2 velocity{0.0};         // [m/s] mean over the window; window 1: no lag, but one encoder count of noise
  glm::dvec2 smooth_velocity{0.0};  // [m/s] low-pass filtered, for damping in free space
  bool fresh = false;               // the sample of this cycle was new, finite and plausible
};

inline constexpr int kMaxWindow = 64;  // [samples]

struct EstimatorConfig {
  double smoothing = 0.004;   // [s] time constant of smooth_velocity
  double speed_limit = 10.0;  // [m/s] a sample that implies a faster motion is rejected
  int window = 1;             // [samples] time span of the velocity estimate; more than 1 needs allow_unstable
  bool operator==(const EstimatorConfig&) const = default;
};

template <>
inline constexpr Parameter<EstimatorConfig> kParameters<EstimatorConfig>[] = {
    {&EstimatorConfig::smoothing, "smoothing", "smoothing_s", FileRange{1e-5, 1.0},
     "Time constant of the velocity that damps the lever in free space.", "Velocity filter", "aisle damping hums",
     "it lags", Display{"ms", 2, 1e3, true}},
    {&EstimatorConfig::speed_limit, "speed_limit", "speed_limit_m_per_s", FileRange{0.1, 1000.0},
     "A reading that implies a faster motion is rejected.", "Max plausible speed", "fast motions are rejected",
     "sensor jumps are accepted", Display{"m/s", 1, 1.0, true}},
    {&EstimatorConfig::window, "window", "window_samples", FileRange{1.0, kMaxWindow},
     "Number of samples over which the velocity at the wall is computed; above 1 needs study.", "Velocity window", "",
     "late damping destabilises the wall", Display{"samples"}},
};
static_assert(DescribesAll<EstimatorConfig>);

class LeverEstimator {
 public:
  // `period`: cycle time [s]. `count`: size of one encoder count at the tip [m]; a jump of one count per axis is always
  // accepted. `stale_time`: time after which the guard reports stale readings [s].
  LeverEstimator(const EstimatorConfig& config, double period, double count = 0.0, double stale_time = 0.0) noexcept;

  // Returns the motion after one reading. A reading that is not finite, jumps, goes backward in time or repeats the
  // previous one is not fresh: position and velocity keep their values. After max(50 ms, `stale_time` + 30 ms) without
  // an accepted sample, the estimator restarts with zero velocity at the next finite reading that is not a repetition,
  // even if it jumps or goes backward in time. By then the guard has reacted to the stale readings. Real-time safe.
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
  double jump_tolerance_;  // [m] length of a jump by one encoder count on both axes
  double restart_after_;   // [s]
  double blend_;           // [1] weight of the newest velocity in smooth_velocity
  LeverMotion motion_;
  std::int64_t accepted_time_ns_ = 0;  // [ns] time of the last accepted sample
  std::uint64_t last_sequence_ = 0;    // sequence number of the last sample, accepted or not
  std::int64_t last_time_ns_ = 0;
  struct Sample {
    glm::dvec2 position{0.0};
    std::int64_t time_ns = 0;
  };
  std::array<Sample, kMaxWindow> history_{};  // accepted samples; unused if the window is 1
  std::size_t history_count_ = 0;             // samples stored since the last start or restart
  double unaccepted_time_ = 0.0;              // [s] time since the last accepted sample
  bool started_ = false;
};

}  // namespace gearshift::haptics
