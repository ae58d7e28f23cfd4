#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/device/checked.h"
#include "haptics/device/hand.h"
#include "haptics/files/number_text.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

// What was found by a search over impact phases, hands, quantisation, jitter and plant error: see README.md.
constexpr double kQuiet = 0.35;          // of m / tau^2 and m / tau: half-sample hold
constexpr double kQuietObserved = 0.58;  // of m / tau^2: with the observer
constexpr double kObservedTau = 0.0045;  // [s] the longest tau at which the observer pays
constexpr double kGainMargin = 1.1;      // of the stiffness, against the exact boundary: plant error and jitter
constexpr double kLeastSlew = 2.0;       // [N/cycle] at 1 a wall's force comes so late that an arm swings by 80 mm
constexpr const char* kWallStiffness = "wall_stiffness_n_per_m";
constexpr const char* kWallDamping = "wall_damping_n_s_per_m";
constexpr const char* kQuietLaw = "quiet half-sample hold: K <= 0.35 m / tau^2, tau = (delay + 1) T";
constexpr const char* kObservedLaw = "quiet observed hold: K <= 0.58 m / tau^2, tau = (delay + 1) T";
constexpr const char* kDampingLaw = "quiet half-sample hold: B <= 0.35 m / tau, tau = (delay + 1) T";
constexpr const char* kStableLaw = "spectral radius of the sampled loop below 1 at 1.1 K";
constexpr const char* kFreeLaw = "spectral radius of the sampled lever outside the loop's walls below 1";
constexpr const char* kObservedDampingLaw = "observed hold: B >= 50 N s/m, or a heavy arm rings";
constexpr const char* kObserverLaw = "spectral radius of the observed loop below 1 at any K";
constexpr const char* kFeelLaw = "passive proxy: no feel stiffer than the wall that carries the proxy";

// Holds a value to a bound, or in a study only says so. The last law that bound a parameter is the one that is told.
struct Limiter {
  bool study;
  std::vector<Limited>& limited;

  void limit(double& value, double most, const char* what, const char* law, std::string_view hand = {}) const {
    if (value <= most) return;
    const double used = study ? value : most;
    const auto same = [&](const Limited& one) { return one.what == what; };
    const auto before = std::find_if(limited.begin(), limited.end(), same);
    const double wanted = before == limited.end() ? value : before->wanted;
    if (before != limited.end()) limited.erase(before);
    limited.push_back({law, what, wanted, used, most, std::string(hand)});
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
  const bool suffices = loop_stiffness(config.tuning, spec) <= kQuiet * lighter_mass(spec) / (tau * tau);
  return suffices || spec.delay == 0 || tau > kObservedTau ? ContactHold::half_sample : ContactHold::observer;
}

void limit_to_quiet(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                    const Limiter& limiter) {
  HapticTuning& tuning = admitted.tuning;
  const double tau = lag(config, spec), damping = kQuiet * lighter_mass(spec) / tau;
  limiter.limit(tuning.aisle_damping, damping, "aisle_damping_n_s_per_m", kDampingLaw);
  limiter.limit(tuning.limit_damping, damping, "limit_damping_n_s_per_m", kDampingLaw);
  const bool observed = admitted.hold == ContactHold::observer;
  if (!observed) limiter.limit(tuning.wall_damping, damping, kWallDamping, kDampingLaw);
  if (admitted.hold == ContactHold::zero_order) return;
  const double stiffness = (observed ? kQuietObserved : kQuiet) * lighter_mass(spec) / (tau * tau);
  limiter.limit(tuning.wall_stiffness, stiffness, kWallStiffness, observed ? kObservedLaw : kQuietLaw);
}

// Not a limit but what the hold is made of: in a study, too.
void raise_observed_damping(AdmittedTuning& admitted) {
  double& damping = admitted.tuning.wall_damping;
  if (admitted.hold != ContactHold::observer || damping >= kObservedDamping) return;
  admitted.limited.push_back({kObservedDampingLaw, kWallDamping, damping, kObservedDamping, kObservedDamping, {}});
  damping = kObservedDamping;
}

// Visits every axis with every listed hand.
void each_lever(const DeviceSpec& spec, const auto& visit) {
  for (const NamedHand& named : kNamedHands)
    for (const AxisModel& axis : {spec.axis_x, spec.axis_y}) visit(axis, named);
}

bool keeps_walls(const DeviceSpec& spec) noexcept {
  return own_wall_stiffness(spec) > 0.0 || own_wall_damping(spec) > 0.0;
}

// In a wall: free of the device's own, and held by it. The loop knows of that one no more than of a hand.
void each_pressed_lever(const DeviceSpec& spec, const auto& visit) {
  each_lever(spec, visit);
  if (!keeps_walls(spec)) return;
  for (const NamedHand& named : kNamedHands) {
    for (const int i : {0, 1}) {
      NamedHand held = named;
      held.hand.stiffness += spec.own_stiffness[i];
      held.hand.damping += spec.own_damping[i];
      visit(i == 0 ? spec.axis_x : spec.axis_y, held);
    }
  }
}

// What the loop makes of the wall while it is being admitted: the device's part comes to it at the end.
ContactLaw loop_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) {
  ContactLaw law = contact_law(config, admitted, spec);
  law.damping = admitted.tuning.wall_damping;
  return law;
}

// Damping alone, away from the loop's walls. A lever without friction or spring is on the boundary and stays there.
bool is_stable_without_wall(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec,
                            double wall_damping) {
  ContactLaw law = loop_law(config, admitted, spec);
  law.hold = ContactHold::zero_order;
  law.stiffness = 0.0;
  law.damping = wall_damping;
  law.free_damping += admitted.tuning.limit_damping;
  double worst = 0.0;
  each_pressed_lever(spec, [&](const AxisModel& axis, const NamedHand& named) {
    worst = std::max(worst, spectral_radius(axis, named.hand, law, period_s(config)));
  });
  return worst < 1.0 + 1e-9;
}

void limit_free_damping(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                        const Limiter& limiter) {
  AdmittedTuning trial = admitted;
  double share = 1.0;
  while (!is_stable_without_wall(config, trial, spec, 0.0) && share > 1e-3) {
    share *= 0.5;
    trial.tuning.aisle_damping = share * admitted.tuning.aisle_damping;
    trial.tuning.limit_damping = share * admitted.tuning.limit_damping;
  }
  limiter.limit(admitted.tuning.aisle_damping, trial.tuning.aisle_damping, "aisle_damping_n_s_per_m", kFreeLaw);
  limiter.limit(admitted.tuning.limit_damping, trial.tuning.limit_damping, "limit_damping_n_s_per_m", kFreeLaw);
}

// A damping that comes late drives a lever which the device's own spring holds, however soft the loop's wall is.
void limit_damping_beside_own_walls(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                                    const Limiter& limiter) {
  if (!keeps_walls(spec) || admitted.hold == ContactHold::observer) return;
  double damping = admitted.tuning.wall_damping;
  while (!is_stable_without_wall(config, admitted, spec, damping) && damping > 1e-3) damping *= 0.5;
  limiter.limit(admitted.tuning.wall_damping, damping, kWallDamping, kFreeLaw);
}

struct StableStiffness {
  double most = std::numeric_limits<double>::infinity();  // [N/m]
  std::string_view hand;                                  // that decides
};

// That wall, and softer ones down to an eighth.
bool bears(const AxisModel& axis, const HandImpedance& hand, ContactLaw law, double stiffness, double period) {
  for (law.stiffness = stiffness; law.stiffness > stiffness / 8.0; law.stiffness *= 0.8)
    if (spectral_radius(axis, hand, law, period) >= 1.0) return false;
  return true;
}

// The wanted stiffness first: where every hand bears it, nothing has to be searched. Nor where one bears what another
// has left of it.
StableStiffness stable_stiffness(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) {
  StableStiffness stable;
  ContactLaw law = loop_law(config, admitted, spec);
  law.stiffness = kGainMargin * admitted.tuning.wall_stiffness;
  const double slow = law.free_damping, fast = slow + admitted.tuning.limit_damping;
  for (const double free_damping : {slow, fast}) {
    law.free_damping = free_damping;
    each_pressed_lever(spec, [&](const AxisModel& axis, const NamedHand& named) {
      if (stable.most == 0.0 || spectral_radius(axis, named.hand, law, period_s(config)) < 1.0) return;
      const bool is_searched = stable.most < std::numeric_limits<double>::infinity();
      if (is_searched && bears(axis, named.hand, law, kGainMargin * stable.most, period_s(config))) return;
      const double most = stiffness_limit(axis, named.hand, law, period_s(config)) / kGainMargin;
      if (most < stable.most) stable = {most, named.name};
    });
  }
  return stable;
}

// Of a wall that is softer than the device's own it keeps a share.
DeviceSpec with_kept_walls(DeviceSpec spec, const HapticTuning& wanted) noexcept {
  const auto share = [](double want, double own) { return own > 0.0 ? std::min(1.0, want / own) : 0.0; };
  spec.own_stiffness *= share(wanted.wall_stiffness, own_wall_stiffness(spec));
  spec.own_damping *= share(wanted.wall_damping, own_wall_damping(spec));
  return spec;
}

// The whole wall: what the laws admit of the loop, and what the device makes of it. Told of it is what is lacking then.
void add_own(AdmittedTuning& admitted, double& value, const char* what, double wanted, double own, const char* unit) {
  if (own == 0.0) return;
  value = std::min(wanted, value + own);
  const auto is_it = [&](const Limited& one) { return one.what == what; };
  const auto told = std::find_if(admitted.limited.begin(), admitted.limited.end(), is_it);
  if (told == admitted.limited.end()) return;
  told->wanted = wanted;
  told->used = value;
  told->bound += own;
  told->law += "; and " + number_text(own) + unit + " that the device keeps itself";
  if (told->bound >= wanted) admitted.limited.erase(told);
}

// The observer's own damping comes too late on this device: the sampled hold then.
AdmittedTuning sampled_instead(HapticConfig config, const DeviceSpec& device, const Gate& gate, std::string_view hand) {
  config.contact.hold = ContactHold::half_sample;
  AdmittedTuning instead = admit_tuning(config, device, gate);
  const double from = static_cast<double>(ContactHold::observer), to = static_cast<double>(instead.hold);
  instead.limited.push_back({kObserverLaw, "hold", from, to, to, std::string(hand)});
  return instead;
}

// What only a study may have.
void refuse_without_study(const HapticConfig& config, const DeviceSpec& spec) {
  if (config.contact.study && !spec.simulated)
    throw std::invalid_argument("study = true: only a simulated device may be driven beyond what is stable");
  if (config.contact.study) return;
  if (config.estimator.window > 1)
    throw std::invalid_argument("window_samples above 1: in a study only, it makes damping destabilise a wall");
  if (!config.contact.reversal_limiter) throw std::invalid_argument("reversal_limiter = false: in a study only");
  if (config.contact.energy_control == EnergyControl::passivity_controller)
    throw std::invalid_argument("energy_control = passivity_controller: in a study only");
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
  require_between("slew_n_per_cycle", config.guard.slew, kLeastSlew, 100.0);
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

void check_device(const DeviceSpec& spec) {
  const auto check_vector = [](const char* name, glm::dvec2 value, double most, const char* unit) {
    require_between(name, value.x, 0.0, most, unit);
    require_between(name, value.y, 0.0, most, unit);
  };
  check_vector("max_force of the device", spec.max_force, 1e4, "N");
  check_vector("continuous_force of the device", spec.continuous_force, 1e4, "N");
  check_vector("workspace of the device", spec.workspace, 10.0, "m");
  require_between("yoke_radius of the device", spec.yoke_radius, 0.0, 10.0, "m");
  require_between("position_step of the device", spec.position_step, 0.0, 0.1, "m");
  check_vector("own_stiffness of the device", spec.own_stiffness, 1e5, "N/m");
  check_vector("own_damping of the device", spec.own_damping, 1e3, "N s/m");
  require_between("delay of the device", spec.delay, 0, kMostDelay, "cycles");
  for (const AxisModel& axis : {spec.axis_x, spec.axis_y}) {
    require_between("mass of the device", axis.mass, 1e-3, 1e3, "kg");
    require_between("damping of the device", axis.damping, 0.0, 1e4, "N s/m");
    require_between("stiffness of the device", axis.stiffness, 0.0, 1e6, "N/m");
  }
}

double loop_stiffness(const HapticTuning& tuning, const DeviceSpec& spec) noexcept {
  return std::max(0.0, tuning.wall_stiffness - own_wall_stiffness(spec));
}

double device_damping(const HapticTuning& tuning, ContactHold hold, const DeviceSpec& spec) noexcept {
  if (hold == ContactHold::observer) return 0.0;
  return std::min(tuning.wall_damping, own_wall_damping(spec));
}

ContactLaw contact_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) noexcept {
  ContactLaw law;
  law.hold = admitted.hold;
  law.stiffness = loop_stiffness(admitted.tuning, spec);
  law.damping = admitted.tuning.wall_damping - device_damping(admitted.tuning, admitted.hold, spec);
  law.window = config.estimator.window;
  law.free_damping = admitted.tuning.aisle_damping;
  law.smoothing = config.estimator.smoothing;
  law.delay = spec.delay;
  return law;
}

AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& device, const Gate& gate) {
  refuse_without_study(config, device);
  DeviceSpec spec = with_kept_walls(device, config.tuning);
  AdmittedTuning out{config.tuning, chosen_hold(config, spec), {}};
  if (out.hold == ContactHold::observer) spec.own_damping = glm::dvec2(0.0);  // it would take it for the hand's
  out.tuning.wall_damping -= own_wall_damping(spec);
  const Limiter limiter{config.contact.study, out.limited};
  limit_to_quiet(config, spec, out, limiter);
  limit_free_damping(config, spec, out, limiter);
  limit_damping_beside_own_walls(config, spec, out, limiter);
  raise_observed_damping(out);
  const StableStiffness stable = stable_stiffness(config, out, spec);
  if (stable.most == 0.0 && !config.contact.study) {
    if (out.hold == ContactHold::observer) return sampled_instead(config, device, gate, stable.hand);
    if (own_wall_stiffness(spec) == 0.0)
      throw std::invalid_argument("no wall of any stiffness is stable on this device");
  }
  limiter.limit(out.tuning.wall_stiffness, stable.most, kWallStiffness, kStableLaw, stable.hand);
  const double feel = stiffest_feel(gate);
  if (feel > 0.0) limiter.limit(out.tuning.feel_scale, out.tuning.wall_stiffness / feel, "feel_scale", kFeelLaw);
  add_own(out, out.tuning.wall_stiffness, kWallStiffness, config.tuning.wall_stiffness, own_wall_stiffness(spec),
          " N/m");
  add_own(out, out.tuning.wall_damping, kWallDamping, config.tuning.wall_damping, own_wall_damping(spec), " N s/m");
  return out;
}

}  // namespace gearshift
