#include "haptics/safety/energy_control.h"

#include <algorithm>
#include <cmath>

namespace gearshift {
namespace {

constexpr double kShare = 0.5;        // of the slope that would be lossless, and bounce for ever under a push
constexpr double kMostDamping = 0.5;  // of m / T
constexpr double kStill = 1e-4;       // [m/s] slower, damping has nothing to act on

}  // namespace

EnergyBounder::EnergyBounder(const AxisModel& handle, int delay, double period) noexcept
    : slope_(kShare * 2.0 * handle.damping / (period * (1.0 + 2.0 * delay))) {}

double EnergyBounder::bound(double wanted, double last, double travel) const noexcept {
  const double most = std::abs(last - slope_ * travel);
  return std::clamp(wanted, -most, most);
}

PassivityController::PassivityController(const AxisModel& handle, double period) noexcept
    : period_(period), most_damping_(kMostDamping * handle.mass / period) {}

double PassivityController::control(double wanted, double last, double travel, bool touches) noexcept {
  taken_ -= last * travel;
  if (!touches) {
    taken_ = 0.0;
    return wanted;
  }
  const double speed = travel / period_;
  const double after = taken_ - wanted * travel;  // if the coming period is like the last
  if (after >= 0.0 || std::abs(speed) < kStill) return wanted;
  const double damping = std::min(most_damping_, -after / (speed * speed * period_));
  return wanted - damping * speed;
}

}  // namespace gearshift
