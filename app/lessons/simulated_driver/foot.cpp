#include "app/lessons/simulated_driver/foot.h"

#include <algorithm>
#include <cmath>

namespace gearshift::lessons {
namespace {

constexpr double kTremorTime = 0.15;  // [s] correlation time of the tremor (engineering value)

}  // namespace

void Foot::move_to(double goal, double rate) noexcept {
  goal_ = std::clamp(goal, 0.0, 1.0);
  rate_ = rate;
}

// The tremor is an Ornstein-Uhlenbeck process, so its standard deviation does not depend on the time step.
double Foot::step(double dt) noexcept {
  value_ += std::clamp(goal_ - value_, -rate_ * dt, rate_ * dt);
  if (noise_ <= 0.0 || value_ <= 0.0 || value_ >= 1.0) return value_;
  if (dt != dt_) {
    dt_ = dt;
    keep_ = std::exp(-dt / kTremorTime);
    spread_ = noise_ * std::sqrt(1.0 - keep_ * keep_);
  }
  tremor_ = keep_ * tremor_ + spread_ * random_.next();
  return std::clamp(value_ + tremor_, 0.0, 1.0);
}

}  // namespace gearshift::lessons
