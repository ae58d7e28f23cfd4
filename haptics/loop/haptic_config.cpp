#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/device/checked.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

// What was found by a search over impact phases, hands, quantisation, jitter and plant error: see README.md.
constexpr double kQuiet = 0.35;          // of m / tau^2 and m / tau: half-sample hold
constexpr double kQuietObserved = 0.58;  // of m / tau^2: with the observer
constexpr double kObservedTau = 0.0045;  // [s] the longest tau at which the observer pays
constexpr double kGainMargin = 1.1;      // of the stiffness, against the exact boundary: plant error and jitter
constexpr const char* kQuietLaw = "quiet half-sample hold: K <= 0.35 m / tau^2, tau = (delay + 1) T";
constexpr const char* kObservedLaw = "quiet observed hold: K <= 0.58 m / tau^2, tau = (delay + 1) T";
constexpr const char* kDampingLaw = "quiet half-sample hold: B <= 0.35 m / tau, tau = (delay + 1) T";
constexpr const char* kStableLaw = "spectral radius of the sampled loop below 1 at 1.1 K";
constexpr const char* kObserverLaw = "spectral radius of the observed loop below 1 at any K";
constexpr const char* kFeelLaw = "passive proxy: no feel stiffer than the wall that carries the proxy";

// Holds a value to a bound, or in a study only says so.
struct Limiter {
  bool study;
  std::vector<Limited>& limited;

  void limit(double& value, double most, const char* what, const char* law, std::string_view hand = {}) const {
    if (value <= most) return;
    const double used = study ? value : most;
    limited.push_back({law, what, value, used, most, std::string(hand)});
    value = used;
  }
};

// [kg] and [s] that the quiet laws are made of.
double lighter_mass(const DeviceSpec& spec) noexcept {
  return std::min(spec.axis_x.mass, spec.axis_y.mass);
}
double lag(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  return (spec.delay + 1.0) * period_s(config);
}

// The observer where the half-sample hold cannot have the wanted stiffness, and delay is what it lacks.
ContactHold chosen_hold(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  if (config.contact.hold != ContactHold::automatic) return config.contact.hold;
  const double tau = lag(config, spec);
  const bool suffices = config.tuning.wall_stiffness <= kQuiet * lighter_mass(spec) / (tau * tau);
  return suffices || spec.delay == 0 || tau > kObservedTau ? ContactHold::half_sample : ContactHold::observer;
}

void limit_to_quiet(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                    const Limiter& limiter) {
  HapticTuning& tuning = admitted.tuning;
  const double tau = lag(config, spec), damping = kQuiet * lighter_mass(spec) / tau;
  limiter.limit(tuning.aisle_damping, damping, "aisle_damping_n_s_per_m", kDampingLaw);
  limiter.limit(tuning.limit_damping, damping, "limit_damping_n_s_per_m", kDampingLaw);
  limiter.limit(tuning.wall_damping, damping, "wall_damping_n_s_per_m", kDampingLaw);
  if (admitted.hold == ContactHold::zero_order) return;
  const bool observed = admitted.hold == ContactHold::observer;
  const double stiffness = (observed ? kQuietObserved : kQuiet) * lighter_mass(spec) / (tau * tau);
  limiter.limit(tuning.wall_stiffness, stiffness, "wall_stiffness_n_per_m", observed ? kObservedLaw : kQuietLaw);
}

struct StableStiffness {
  double most = std::numeric_limits<double>::infinity();  // [N/m]
  std::string_view hand;                                  // that decides
};

// The wanted stiffness first: where every hand bears it, nothing has to be searched.
StableStiffness stable_stiffness(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) {
  ContactLaw law;
  law.hold = admitted.hold;
  law.stiffness = kGainMargin * admitted.tuning.wall_stiffness;
  law.damping = admitted.tuning.wall_damping;
  law.window = config.estimator.window;
  law.free_damping = admitted.tuning.aisle_damping;
  law.smoothing = config.estimator.smoothing;
  law.delay = spec.delay;
  StableStiffness stable;
  for (const NamedHand& named : kNamedHands) {
    for (const AxisModel& axis : {spec.axis_x, spec.axis_y}) {
      if (spectral_radius(axis, named.hand, law, period_s(config)) < 1.0) continue;
      const double most = stiffness_limit(axis, named.hand, law, period_s(config)) / kGainMargin;
      if (most < stable.most) stable = {most, named.name};
    }
  }
  return stable;
}

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
  require_between("window_samples", config.estimator.window, 1, kMostWindow);
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

AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& spec, const Gate& gate) {
  if (config.contact.study && !spec.simulated) {
    throw std::invalid_argument("study = true: only a simulated device may be driven beyond what is stable");
  }
  AdmittedTuning out{config.tuning, chosen_hold(config, spec), {}};
  const Limiter limiter{config.contact.study, out.limited};
  limit_to_quiet(config, spec, out, limiter);
  StableStiffness stable = stable_stiffness(config, out, spec);
  if (out.hold == ContactHold::observer && stable.most == 0.0 && !config.contact.study) {
    // Not even without stiffness: the observer's own damping comes too late. The sampled hold then.
    out = {config.tuning, ContactHold::half_sample, {}};
    out.limited.push_back({kObserverLaw, "hold", static_cast<double>(ContactHold::observer),
                           static_cast<double>(out.hold), static_cast<double>(out.hold), std::string(stable.hand)});
    limit_to_quiet(config, spec, out, limiter);
    stable = stable_stiffness(config, out, spec);
  }
  limiter.limit(out.tuning.wall_stiffness, stable.most, "wall_stiffness_n_per_m", kStableLaw, stable.hand);
  const double feel = stiffest_feel(gate);
  if (feel > 0.0) {
    limiter.limit(out.tuning.feel_scale, out.tuning.wall_stiffness / feel, "feel_scale", kFeelLaw);
  }
  return out;
}

}  // namespace gearshift
