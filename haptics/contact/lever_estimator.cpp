#include "haptics/contact/lever_estimator.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gearshift {
namespace {

constexpr double kReacquireAfter = 0.050;  // [s] without a believed sample, then the next one is a new start

bool is_finite(glm::dvec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace

LeverEstimator::LeverEstimator(const EstimatorConfig& config, double period) noexcept
    : config_(config), period_(period), blend_(1.0 - std::exp(-period / config.smoothing)) {}

LeverMotion LeverEstimator::update(const LeverReading& reading) noexcept {
  motion_.fresh = false;
  const bool is_new = !started_ || (reading.sequence > seen_sequence_ && reading.time_ns > seen_time_ns_);
  if (!is_new || !is_finite(reading.position)) return hold();
  if (!started_) return restart(reading);

  // A jump is judged by the time since the last reading of any kind, two periods at most: neither a lying nor
  // a silent sensor gains credit for a wilder jump.
  const glm::dvec2 travel = reading.position - motion_.position;
  const double since_seen =
      period_ * static_cast<double>(std::min<std::uint64_t>(2, reading.sequence - seen_sequence_));
  seen_sequence_ = reading.sequence;
  seen_time_ns_ = reading.time_ns;
  if (glm::length(travel) > config_.speed_limit * since_seen) {
    return unbelieved_ >= kReacquireAfter ? restart(reading) : hold();
  }
  accept(reading, travel / (period_ * static_cast<double>(reading.sequence - sequence_)));
  return motion_;
}

LeverMotion LeverEstimator::hold() noexcept {
  unbelieved_ += period_;
  return motion_;
}

LeverMotion LeverEstimator::restart(const LeverReading& reading) noexcept {
  started_ = true;
  motion_.smooth_velocity = {0.0, 0.0};
  accept(reading, {0.0, 0.0});
  return motion_;
}

void LeverEstimator::accept(const LeverReading& reading, glm::dvec2 velocity) noexcept {
  sequence_ = seen_sequence_ = reading.sequence;
  seen_time_ns_ = reading.time_ns;
  unbelieved_ = 0.0;
  motion_.position = reading.position;
  motion_.velocity = velocity;
  motion_.smooth_velocity += blend_ * (velocity - motion_.smooth_velocity);
  motion_.fresh = true;
}

}  // namespace gearshift
