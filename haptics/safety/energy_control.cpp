#include "haptics/safety/energy_control.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

// [1] slope of the bound as a fraction of Kim and Ryu's limit; below 1, because at the limit a pushed lever never comes
// to rest
constexpr double kBoundFraction = 0.5;
constexpr double kMaxDampingFraction = 0.5;  // [1] highest damping, as a fraction of mass / period
constexpr double kMinSpeed = 1e-4;           // [m/s] lowest speed at which damping is added

}  // namespace

EnergyBounder::EnergyBounder(const AxisModel& handle, int delay, double period) noexcept
    : slope_(kBoundFraction * 2.0 * handle.damping / (period * (1.0 + 2.0 * delay))) {}

double EnergyBounder::bound(double wanted, double last, double travel) const noexcept {
  const double limit = std::abs(last - slope_ * travel);
  return std::clamp(wanted, -limit, limit);
}

PassivityController::PassivityController(const AxisModel& handle, double period) noexcept
    : period_(period), max_damping_(kMaxDampingFraction * handle.mass / period) {}

double PassivityController::control(double wanted, double last, double travel, bool in_contact) noexcept {
  absorbed_energy_ -= last * travel;
  if (!in_contact) {
    absorbed_energy_ = 0.0;
    return wanted;
  }
  const double speed = travel / period_;
  const double predicted = absorbed_energy_ - wanted * travel;  // [J] energy balance if the same `travel` follows
  if (predicted >= 0.0 || std::abs(speed) < kMinSpeed) return wanted;
  const double damping = std::min(max_damping_, -predicted / (speed * speed * period_));
  return wanted - damping * speed;
}

const char* file_key(EnergyControl control) noexcept {
  static constexpr const char* kKeys[] = {"none", "energy_bounding", "passivity_controller"};
  return kKeys[static_cast<int>(control)];
}

const char* to_string(EnergyControl control) noexcept {
  static constexpr const char* kTexts[] = {"none", "energy bounding", "passivity controller"};
  return kTexts[static_cast<int>(control)];
}

}  // namespace gearshift::haptics
