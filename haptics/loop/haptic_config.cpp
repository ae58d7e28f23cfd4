#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/checked.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

void limit(double& value, double most, const char* what, const char* law, std::vector<Limited>& limited) {
  if (value <= most) return;
  limited.push_back({law, what, value, most});
  value = most;
}

constexpr double kHoldMargin = 0.35;  // of m / tau^2 and m / tau, see the header
constexpr const char* kStiffnessLaw = "half-sample hold with delay: K <= 0.35 m / tau^2, tau = (delay + 1) T";
constexpr const char* kDampingLaw = "half-sample hold with delay: B <= 0.35 m / tau, tau = (delay + 1) T";
constexpr const char* kFeelLaw = "passive proxy: no feel stiffer than the wall that carries the proxy";

}  // namespace

std::int64_t period_ns(const HapticConfig& config) noexcept {
  return std::llround(1e9 / config.rate);
}

double period_s(const HapticConfig& config) noexcept {
  return 1e-9 * static_cast<double>(period_ns(config));
}

void check_tuning(const HapticTuning& tuning) {
  require_between("wall_stiffness_n_per_m", tuning.wall_stiffness, 0.0, 20000.0);
  require_between("wall_damping_n_s_per_m", tuning.wall_damping, 0.0, 100.0);
  require_between("feel_scale", tuning.feel_scale, 0.0, 4.0);
  require_between("aisle_damping_n_s_per_m", tuning.aisle_damping, 0.0, 50.0);
  require_between("speed_limit_m_per_s", tuning.speed_limit, 0.05, 5.0);
  require_between("limit_damping_n_s_per_m", tuning.limit_damping, 0.0, 50.0);
}

void check_config(const HapticConfig& config) {
  require_between("rate_hz", config.rate, 100.0, 4000.0);
  check_tuning(config.tuning);
  require_between("smoothing_s", config.estimator.smoothing, 1e-5, 1.0);
  require_between("speed_limit_of_readings_m_per_s", config.estimator.speed_limit, 0.1, 1000.0);
  require_between("slew_n_per_cycle", config.guard.slew, 0.1, 100.0);
  require_between("ramp_time_s", config.guard.ramp_time, 0.001, 60.0);
  require_between("stale_time_s", config.guard.stale_time, 0.001, 1.0);
  require_between("fade_time_s", config.guard.fade_time, 0.001, 1.0);
  require_between("overruns_in_row", config.guard.overruns_in_row, 1, 1000);
  require_between("damped_damping_n_s_per_m", config.guard.damped_damping, 0.0, 50.0);
  require_between("position_margin_m", config.guard.position_margin, 0.0, 1.0);
  require_between("warn_above_n", config.over_push.warn_above, 1.0, 1000.0);
  require_between("clear_below_n", config.over_push.clear_below, 0.0, config.over_push.warn_above);
  require_between("gear_debounce_s", config.gear_debounce, 0.0, 0.5);
  require_between("ghost_offset_m", config.ghost_offset, 0.0, 1.0);
}

AdmittedTuning admit_tuning(const HapticTuning& wanted, double period, const DeviceSpec& spec, const Gate& gate) {
  AdmittedTuning out{wanted, {}};
  const double mass = std::min(spec.axis_x.mass, spec.axis_y.mass);
  const double tau = (spec.delay + 1.0) * period;
  limit(out.tuning.wall_stiffness, kHoldMargin * mass / (tau * tau), "wall_stiffness_n_per_m", kStiffnessLaw,
        out.limited);
  limit(out.tuning.wall_damping, kHoldMargin * mass / tau, "wall_damping_n_s_per_m", kDampingLaw, out.limited);
  limit(out.tuning.limit_damping, kHoldMargin * mass / tau, "limit_damping_n_s_per_m", kDampingLaw, out.limited);
  limit(out.tuning.aisle_damping, kHoldMargin * mass / tau, "aisle_damping_n_s_per_m", kDampingLaw, out.limited);
  const double feel = stiffest_feel(gate);
  if (feel > 0.0) {
    limit(out.tuning.feel_scale, out.tuning.wall_stiffness / feel, "feel_scale", kFeelLaw, out.limited);
  }
  return out;
}

}  // namespace gearshift
