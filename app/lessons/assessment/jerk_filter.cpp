#include "app/lessons/assessment/jerk_filter.h"

#include <cmath>

namespace gearshift::lessons {
namespace {

constexpr double kOmega = 6.283185307179586 * kJerkCutoff;  // [rad/s]
constexpr double kDecay = kOmega * 0.70710678118654752440;  // [1/s] decay rate s, equal to the damped frequency

}  // namespace

// Steps the filter by its exact solution e(t) = exp(-s t) (e0 cos(s t) + (e0' + s e0) / s sin(s t)). The error e is the
// output minus the input, e0 and e0' are the error and its rate at the start of the period, and s is kDecay.
double JerkFilter::update(double acceleration, double dt) noexcept {
  if (!std::isfinite(acceleration) || !std::isfinite(dt)) return rate_;
  if (!filled_) {
    filled_ = true;
    level_ = acceleration;
    return rate_;
  }
  const double error = level_ - acceleration;
  const double fade = std::exp(-kDecay * dt);
  const double cosine = fade * std::cos(kDecay * dt), sine = fade * std::sin(kDecay * dt) / kDecay;
  level_ = acceleration + error * cosine + (rate_ + kDecay * error) * sine;
  rate_ = rate_ * cosine - (kDecay * rate_ + kOmega * kOmega * error) * sine;
  return rate_;
}

}  // namespace gearshift::lessons
