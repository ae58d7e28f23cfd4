#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

void require(double value, double min, double max, const char* name) {
  if (std::isfinite(value) && value >= min && value <= max) return;
  throw std::invalid_argument(std::string(name) + " = " + number(value) + ": must be between " + number(min) +
                              " and " + number(max));
}

void limit(double& value, double most, const char* what, const char* law, std::vector<Limited>& limited) {
  if (value <= most) return;
  limited.push_back({law, what, value, most});
  value = most;
}

constexpr double kHoldMargin =
    0.35;  // of m / tau^2 and m / tau: found by search over hands, phases and jitter
constexpr const char* kStiffnessLaw = "half-sample hold with delay: K <= 0.35 m / tau^2, tau = (delay + 1) T";
constexpr const char* kDampingLaw = "half-sample hold with delay: B <= 0.35 m / tau, tau = (delay + 1) T";
constexpr const char* kFeelLaw = "passive proxy: no feel stiffer than the wall that carries the proxy";

}  // namespace

std::int64_t period_ns(const HapticConfig& config) noexcept {
  return std::llround(1e9 / config.rate);
}

void check_tuning(const HapticTuning& tuning) {
  require(tuning.wall_stiffness, 0.0, 20000.0, "wall_stiffness_n_per_m");
  require(tuning.wall_damping, 0.0, 100.0, "wall_damping_n_s_per_m");
  require(tuning.feel_scale, 0.0, 4.0, "feel_scale");
  require(tuning.aisle_damping, 0.0, 50.0, "aisle_damping_n_s_per_m");
  require(tuning.speed_limit, 0.05, 5.0, "speed_limit_m_per_s");
  require(tuning.limit_damping, 0.0, 50.0, "limit_damping_n_s_per_m");
}

void check_config(const HapticConfig& config) {
  require(config.rate, 100.0, 4000.0, "rate_hz");
  check_tuning(config.tuning);
  require(config.estimator.smoothing, 1e-5, 1.0, "smoothing_s");
  require(config.estimator.speed_limit, 0.1, 1000.0, "speed_limit_of_readings_m_per_s");
  require(config.guard.slew, 0.1, 100.0, "slew_n_per_cycle");
  require(config.guard.ramp_time, 0.001, 60.0, "ramp_time_s");
  require(config.guard.stale_time, 0.001, 1.0, "stale_time_s");
  require(config.guard.fade_time, 0.001, 1.0, "fade_time_s");
  require(config.guard.overruns_in_row, 1, 1000, "overruns_in_row");
  require(config.guard.damped_damping, 0.0, 50.0, "damped_damping_n_s_per_m");
  require(config.guard.position_margin, 0.0, 1.0, "position_margin_m");
  require(config.over_push.warn_above, 1.0, 1000.0, "warn_above_n");
  require(config.over_push.clear_below, 0.0, config.over_push.warn_above, "clear_below_n");
  require(config.gear_debounce, 0.0, 0.5, "gear_debounce_s");
  require(config.ghost_offset, 0.0, 1.0, "ghost_offset_m");
}

AdmittedTuning admit_tuning(const HapticTuning& wanted, double period, const DeviceSpec& spec,
                            const Gate& gate) {
  AdmittedTuning out{wanted, {}};
  const double mass = std::min(spec.axis_x.mass, spec.axis_y.mass);
  const double tau = (spec.delay + 1.0) * period;
  limit(out.tuning.wall_stiffness, kHoldMargin * mass / (tau * tau), "wall_stiffness_n_per_m", kStiffnessLaw,
        out.limited);
  limit(out.tuning.wall_damping, kHoldMargin * mass / tau, "wall_damping_n_s_per_m", kDampingLaw,
        out.limited);
  limit(out.tuning.limit_damping, kHoldMargin * mass / tau, "limit_damping_n_s_per_m", kDampingLaw,
        out.limited);
  limit(out.tuning.aisle_damping, kHoldMargin * mass / tau, "aisle_damping_n_s_per_m", kDampingLaw,
        out.limited);
  const double feel = stiffest_feel(gate);
  if (feel > 0.0) {
    limit(out.tuning.feel_scale, out.tuning.wall_stiffness / feel, "feel_scale", kFeelLaw, out.limited);
  }
  return out;
}

}  // namespace gearshift
