#include "haptics/contact/lever_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

constexpr double kRestartAfter = 0.050;  // [s] the estimator restarts after this time without an accepted sample
constexpr double kGuardLead = 0.030;     // [s] added to the guard's stale time, so that the guard reacts first
constexpr double kRounding = 1e-6;       // [1] rounding tolerance, as a fraction of one encoder count

}  // namespace

LeverEstimator::LeverEstimator(const EstimatorConfig& config, double period, double count, double stale_time) noexcept
    : config_(config),
      period_(period),
      jump_tolerance_(std::numbers::sqrt2 * count * (1.0 + kRounding)),
      restart_after_(std::max(kRestartAfter, stale_time + kGuardLead)),
      blend_(1.0 - std::exp(-period / config.smoothing)) {}

LeverMotion LeverEstimator::update(const LeverReading& reading) noexcept {
  motion_.fresh = false;
  if (!is_finite(reading.position)) return hold();
  const bool is_lost = !started_ || unaccepted_time_ >= restart_after_;
  if (is_lost && (!started_ || reading.sequence != last_sequence_)) return restart(reading);
  if (reading.sequence <= last_sequence_ || reading.time_ns <= last_time_ns_) return hold();

  // The allowed jump grows with the time since the previous reading, accepted or not, up to two periods. Without this
  // limit, a larger jump would become plausible after the sensor was faulty or silent.
  const glm::dvec2 travel = reading.position - motion_.position;
  const double since_last = std::min(2.0 * period_, seconds(last_time_ns_, reading.time_ns));
  const double since_accepted = seconds(accepted_time_ns_, reading.time_ns);
  last_sequence_ = reading.sequence;
  last_time_ns_ = reading.time_ns;
  if (glm::length(travel) > jump_tolerance_ + config_.speed_limit * since_last) return hold();
  accept(reading, window_velocity(reading, travel / since_accepted));
  return motion_;
}

// Velocity over the newest `window` samples, or over all samples if there are fewer. Returns `newest` if the window is
// 1.
glm::dvec2 LeverEstimator::window_velocity(const LeverReading& reading, glm::dvec2 newest) const noexcept {
  const std::size_t window = std::min(static_cast<std::size_t>(config_.window), history_count_);
  if (window <= 1) return newest;
  const Sample& oldest = history_[(history_count_ - window) % history_.size()];
  return (reading.position - oldest.position) / seconds(oldest.time_ns, reading.time_ns);
}

void LeverEstimator::store_sample(const LeverReading& reading) noexcept {
  history_[history_count_ % history_.size()] = {reading.position, reading.time_ns};
  ++history_count_;
}

// Time between two samples on the device's own clock, which need not be synchronous with the loop. Is at least half a
// period, so that clock jitter cannot produce a large speed.
double LeverEstimator::seconds(std::int64_t from_ns, std::int64_t to_ns) const noexcept {
  return std::max(0.5 * period_, 1e-9 * static_cast<double>(to_ns - from_ns));
}

LeverMotion LeverEstimator::hold() noexcept {
  unaccepted_time_ += period_;
  return motion_;
}

LeverMotion LeverEstimator::restart(const LeverReading& reading) noexcept {
  started_ = true;
  motion_.smooth_velocity = {0.0, 0.0};
  history_count_ = 0;
  accept(reading, {0.0, 0.0});
  return motion_;
}

void LeverEstimator::accept(const LeverReading& reading, glm::dvec2 velocity) noexcept {
  last_sequence_ = reading.sequence;
  accepted_time_ns_ = last_time_ns_ = reading.time_ns;
  unaccepted_time_ = 0.0;
  motion_.position = reading.position;
  motion_.velocity = velocity;
  motion_.smooth_velocity += blend_ * (velocity - motion_.smooth_velocity);
  motion_.fresh = true;
  if (config_.window > 1) store_sample(reading);
}

}  // namespace gearshift::haptics
