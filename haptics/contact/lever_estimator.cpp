#include "haptics/contact/lever_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift {
namespace {

constexpr double kLostAfter = 0.050;   // [s] without a believed sample, then the next one is a new start
constexpr double kGuardFirst = 0.030;  // [s] but the guard falls so long before: a lying sensor is not fresh to it
constexpr double kRounding = 1e-6;     // [1] of a count

}  // namespace

LeverEstimator::LeverEstimator(const EstimatorConfig& config, double period, double count, double stale_time) noexcept
    : config_(config),
      period_(period),
      edge_(std::numbers::sqrt2 * count * (1.0 + kRounding)),
      lost_after_(std::max(kLostAfter, stale_time + kGuardFirst)),
      blend_(1.0 - std::exp(-period / config.smoothing)) {}

LeverMotion LeverEstimator::update(const LeverReading& reading) noexcept {
  motion_.fresh = false;
  if (!is_finite(reading.position)) return hold();
  const bool is_lost = !started_ || unbelieved_ >= lost_after_;
  if (is_lost && (!started_ || reading.sequence != seen_sequence_)) return restart(reading);
  if (reading.sequence <= seen_sequence_ || reading.time_ns <= seen_time_ns_) return hold();

  // A jump is judged by the time since the last reading of any kind, two periods at most: neither a lying nor a
  // silent sensor gains credit for a wilder jump.
  const glm::dvec2 travel = reading.position - motion_.position;
  const double since_seen = std::min(2.0 * period_, seconds(seen_time_ns_, reading.time_ns));
  const double since_believed = seconds(time_ns_, reading.time_ns);
  seen_sequence_ = reading.sequence;
  seen_time_ns_ = reading.time_ns;
  if (glm::length(travel) > edge_ + config_.speed_limit * since_seen) return hold();
  accept(reading, window_velocity(reading, travel / since_believed));
  return motion_;
}

// Over `window` samples, or as many as there are. The newest difference where the window is one.
glm::dvec2 LeverEstimator::window_velocity(const LeverReading& reading, glm::dvec2 newest) const noexcept {
  const std::size_t window = std::min(static_cast<std::size_t>(config_.window), past_count_);
  if (window <= 1) return newest;
  const Sample& then = past_[(past_count_ - window) % past_.size()];
  return (reading.position - then.position) / seconds(then.time_ns, reading.time_ns);
}

void LeverEstimator::remember(const LeverReading& reading) noexcept {
  past_[past_count_ % past_.size()] = {reading.position, reading.time_ns};
  ++past_count_;
}

// Time between two samples by the device's own clock, which need not tick with the loop. Half a period at least: a
// clock that jitters must not make speed.
double LeverEstimator::seconds(std::int64_t from_ns, std::int64_t to_ns) const noexcept {
  return std::max(0.5 * period_, 1e-9 * static_cast<double>(to_ns - from_ns));
}

LeverMotion LeverEstimator::hold() noexcept {
  unbelieved_ += period_;
  return motion_;
}

LeverMotion LeverEstimator::restart(const LeverReading& reading) noexcept {
  started_ = true;
  motion_.smooth_velocity = {0.0, 0.0};
  past_count_ = 0;
  accept(reading, {0.0, 0.0});
  return motion_;
}

void LeverEstimator::accept(const LeverReading& reading, glm::dvec2 velocity) noexcept {
  seen_sequence_ = reading.sequence;
  time_ns_ = seen_time_ns_ = reading.time_ns;
  unbelieved_ = 0.0;
  motion_.position = reading.position;
  motion_.velocity = velocity;
  motion_.smooth_velocity += blend_ * (velocity - motion_.smooth_velocity);
  motion_.fresh = true;
  if (config_.window > 1) remember(reading);
}

}  // namespace gearshift
