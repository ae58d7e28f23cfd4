#include "app/lessons/assessment/jerk_filter.h"

#include <cmath>

namespace gearshift::lessons {
namespace {

constexpr double kOmega = 6.283185307179586 * kJerkCutoff;  // [rad/s]
constexpr double kDecay = kOmega * 0.70710678118654752440;  // [1/s] s, which is also the damped frequency

}  // namespace

// The solution is e(t) = exp(-s t) (e0 cos(s t) + (e0' + s e0) / s sin(s t)), where e = y - u.
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
