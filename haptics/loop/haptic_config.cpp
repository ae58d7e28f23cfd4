#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/device/hand.h"
#include "haptics/files/number_text.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/range_check.h"

namespace gearshift::haptics {
namespace {

// These bounds were found by a search over impact phases, hands, quantisation, jitter and plant error: see
// haptics/loop/README.md.
constexpr double kQuiet = 0.25;         // [1] sampled holds: limit of stiffness*lag^2/mass
constexpr double kQuietDamping = 0.35;  // [1] the same of damping*lag/mass
constexpr double kSlowSpring = 0.35;    // [1] ... and of the stiffness of a device's springs under the half-sample hold
constexpr double kSlowSpringHeld = 0.15;  // [1] ... and under the zero-order hold
constexpr double kQuietObserved = 0.58;   // [1] observer hold: limit of stiffness*lag^2/mass
constexpr double kQuietOnSpring = 0.5;    // [1] replaces kQuietObserved on a device's springs of more than m / tau^2
constexpr double kObservedTau = 0.0125;   // [s] longest lag at which the observer hold is preferred
constexpr double kGainMargin = 1.1;       // [1] factor on the stiffness, a margin for plant error and jitter
constexpr double kMaxCountForce = 3.0;    // [N] largest change of a damping force by one encoder count
constexpr double kSlowImpact = 0.1;       // [m/s] the encoder must resolve a contact at this speed
constexpr double kDampedImpact = 0.08;    // [m/s] at this speed, damping must outweigh one encoder count
constexpr double kLongTau = 0.015;        // [s] a longer lag adds energy to an impact, whatever stiffness and damping
constexpr double kMinCounts = 3.0;        // [counts] least depth at which a wall stops a lever of that speed
constexpr double kMaxCountSpeed = 0.125;  // [m/s] largest change of the observed velocity by one encoder count
constexpr double kQuietCoarse = 0.2;      // [1] replaces kQuiet where a count changes the observed velocity by more
constexpr double kFastImpact = 1.0;       // [m/s] the slew limit must follow a contact at this speed
constexpr double kFastSwing = 10.0;       // [Hz] the reversal limiter may take a faster swing for chatter ...
constexpr double kHalfSwings = 7.0;       // [1] ... of which it looks at so many half-swings
constexpr double kSwingAccuracy = 1e-4;   // [1] relative, of the stiffness that this allows
constexpr NamedHand kHeaviestHand = kNamedHands.back();
constexpr double kSwingDecay = 1.0 / 3.0;  // [1] ... and must shrink to this fraction; the limiter asks for half
constexpr const char* kQuietLaw = "the half-sample hold is quiet only if K <= 0.25 m / tau^2, with tau = (delay + 1) T";
constexpr const char* kZeroOrderLaw =
    "the zero-order hold is quiet only if K <= 0.25 m / tau^2, with tau = (delay + 1) T";
constexpr const char* kMinDampingLaw =
    "an impact gains energy from the encoder's count q and the delay unless B >= K (q / (0.08 m/s) + 0.1 tau), with "
    "tau "
    "= (delay + 1) T";
constexpr const char* kZeroOrderDampingLaw =
    "with the zero-order hold, an impact gains energy from the encoder's count q and the delay unless B >= K (q / "
    "(0.08 "
    "m/s) + (2.1 delay + 1.1) T)";
constexpr const char* kCoarseLaw =
    "with so coarse an encoder, the half-sample hold is quiet only if K <= 0.2 m / tau^2, with tau = (delay + 1) T";
constexpr const char* kLateLaw =
    "a sampled hold is quiet only if K <= 0.25 m / tau^2, with tau = (delay + 1) T; above 15 ms an impact gains energy "
    "anyway";
constexpr const char* kObservedLaw = "the observer hold is quiet only if K <= 0.58 m / tau^2, with tau = (delay + 1) T";
constexpr const char* kSpringLaw =
    "on the device's springs of more than m / tau^2, the observer hold is quiet only if K <= 0.5 m / tau^2, with tau = "
    "(delay + 1) T";
constexpr const char* kSpringDampingLaw =
    "on the device's springs k, the late half-sample hold adds energy to an impact if k tau^2 > 0.35 m, with tau = "
    "(delay + 1) T";
constexpr const char* kHeldSpringLaw =
    "on the device's springs k, the late zero-order hold adds energy to an impact if k tau^2 > 0.15 m, with tau = "
    "(delay "
    "+ 1) T";
constexpr const char* kSwingLaw =
    "with the observer hold, a swing above 10 Hz must shrink to a third in seven half-swings at 1.1 K, or the reversal "
    "limiter softens the wall";
constexpr const char* kDampingLaw =
    "damping by a sampled velocity is quiet only if B <= 0.35 m / tau, with tau = (delay + 1) T";
constexpr const char* kStableLaw = "the spectral radius of the sampled loop must be below 1 at 1.1 K";
constexpr const char* kFreeLaw = "the spectral radius of the sampled lever must be below 1 outside the loop's walls";
constexpr const char* kObservedDampingLaw = "the observer hold is stiff and quiet with B = 0.7 m / tau";
constexpr const char* kObserverLaw = "with the observer hold, the spectral radius of the loop is not below 1 at any K";
constexpr const char* kCountDampingLaw =
    "one encoder count q changes the damping force by at most 3 N if B <= 3 N T / q";
constexpr const char* kCountFreeDampingLaw =
    "one encoder count q changes the damping force by at most 3 N if B <= 3 N T / (q (1 - exp(-T / smoothing)))";
constexpr const char* kCountStiffnessLaw =
    "the encoder resolves a contact at 0.1 m/s, by 3 counts q, only if K <= m (0.1 m/s / (3 q))^2";
constexpr const char* kCountObserverLaw =
    "with the observer hold, one encoder count q changes the velocity by more than 0.125 m/s";
constexpr const char* kSlewLaw = "the slew limit S per cycle follows a contact at 1 m/s only if K <= S / (T 1 m/s)";
constexpr const char* kStableFeelLaw =
    "the spectral radius of the sampled loop must be below 1 at 1.1 times the gate's stiffest force";
constexpr const char* kFeelLaw = "the proxy is passive only if no gate force is stiffer than the wall";

// Moves a value to a bound, or with allow_unstable only reports the bound. If several laws limit a parameter, only the
// tightest is reported.
struct Limiter {
  bool allow_unstable;
  std::vector<TuningLimit>& limits;

  void limit(double& value, double max, TuningParameter parameter, const char* law, std::string_view hand = {}) const {
    if (value > max) move(value, max, parameter, law, hand);
  }
  void raise(double& value, double min, TuningParameter parameter, const char* law) const {
    if (value < min) move(value, min, parameter, law, {});
  }

 private:
  void move(double& value, double bound, TuningParameter parameter, const char* law, std::string_view hand) const {
    const double used = allow_unstable ? value : bound;
    const auto same = [&](const TuningLimit& one) { return one.parameter == parameter; };
    const auto before = std::find_if(limits.begin(), limits.end(), same);
    // With allow_unstable the value has not moved to the bound before, which may be tighter.
    if (before != limits.end() && (bound < value ? before->bound <= bound : before->bound >= bound)) return;
    const double wanted = before == limits.end() ? value : before->wanted;
    if (before != limits.end()) limits.erase(before);
    limits.push_back({law, parameter, wanted, used, bound, std::string(hand)});
    value = used;
  }
};

// The mass m [kg] and the lag tau [s] in the laws for quiet contact.
double lighter_mass(const DeviceSpec& spec) noexcept {
  return std::min(spec.axis_x.mass, spec.axis_y.mass);
}
double lag(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  return (spec.delay + 1.0) * period_s(config);
}

// One encoder count changes the observed velocity by about the count times the observer's bandwidth. If that is more than
// kMaxCountSpeed, a slow contact with the observer hold gains energy.
bool can_observe(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  return observer_bandwidth(period_s(config)) * spec.position_step <= kMaxCountSpeed;
}

// True if a bare lever on the device's springs swings so fast that a sampled hold pushes it out of the wall: its late damper
// acts mostly while the lever leaves.
bool is_on_fast_spring(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  const double tau = lag(config, spec);
  const double slow = config.contact.hold == ContactHold::zero_order ? kSlowSpringHeld : kSlowSpring;
  return usable_wall_stiffness(spec) * tau * tau > slow * lighter_mass(spec);
}
const char* fast_spring_law(ContactHold hold) noexcept {
  return hold == ContactHold::zero_order ? kHeldSpringLaw : kSpringDampingLaw;
}

// Selects the observer hold if the half-sample hold cannot reach the wanted stiffness because of the rate or the device's
// delay, or adds energy because of the device's springs.
ContactHold select_hold(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  if (config.contact.hold != ContactHold::automatic) return config.contact.hold;
  const double tau = lag(config, spec);
  const double stiffness = loop_stiffness(config.tuning, spec);
  const bool suffices =
      stiffness == 0.0 || (stiffness <= kQuiet * lighter_mass(spec) / (tau * tau) && !is_on_fast_spring(config, spec));
  const bool is_observed = !suffices && tau <= kObservedTau && can_observe(config, spec);
  return is_observed ? ContactHold::observer : ContactHold::half_sample;
}

// Largest quiet damping by a sampled velocity. [N s/m]
double quiet_damping(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  return kQuietDamping * lighter_mass(spec) / lag(config, spec);
}
// Largest damping that the encoder's resolution allows. [N s/m]
double count_damping(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  if (spec.position_step == 0.0) return std::numeric_limits<double>::infinity();
  return kMaxCountForce * config.estimator.window * period_s(config) / spec.position_step;
}

void limit_to_quiet(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                    const Limiter& limiter) {
  HapticTuning& tuning = admitted.tuning;
  const double tau = lag(config, spec), damping = quiet_damping(config, spec);
  limiter.limit(tuning.aisle_damping, damping, &HapticTuning::aisle_damping, kDampingLaw);
  limiter.limit(tuning.limit_damping, damping, &HapticTuning::limit_damping, kDampingLaw);
  const bool observed = admitted.hold == ContactHold::observer;
  if (!observed) limiter.limit(tuning.wall_damping, damping, &HapticTuning::wall_damping, kDampingLaw);
  const auto limit_stiffness = [&](double factor, const char* law) {
    limiter.limit(tuning.wall_stiffness, factor * lighter_mass(spec) / (tau * tau), &HapticTuning::wall_stiffness, law);
  };
  // On stiff springs a bare lever swings so fast that the late loop hardly damps it.
  const bool on_spring = usable_wall_stiffness(spec) > lighter_mass(spec) / (tau * tau);
  if (observed && on_spring) return limit_stiffness(kQuietOnSpring, kSpringLaw);
  if (observed) return limit_stiffness(kQuietObserved, kObservedLaw);
  const char* law = admitted.hold == ContactHold::zero_order ? kZeroOrderLaw : kQuietLaw;
  limit_stiffness(kQuiet, tau > kLongTau ? kLateLaw : law);
  if (!can_observe(config, spec)) limit_stiffness(kQuietCoarse, kCoarseLaw);
}

// Limits what the encoder's resolution allows. A count changes the velocity of one cycle by q / (window T), and so the
// damping force by B q / (window T); the filter of the smooth velocity passes 1 - exp(-T / smoothing) of it.
void limit_to_resolution(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                         const Limiter& limiter) {
  if (spec.position_step == 0.0) return;
  HapticTuning& tuning = admitted.tuning;
  const double damping = count_damping(config, spec);
  const double free_damping = damping / -std::expm1(-period_s(config) / config.estimator.smoothing);
  const double stop_time = kMinCounts * spec.position_step / kSlowImpact;
  limiter.limit(tuning.aisle_damping, free_damping, &HapticTuning::aisle_damping, kCountFreeDampingLaw);
  limiter.limit(tuning.limit_damping, free_damping, &HapticTuning::limit_damping, kCountFreeDampingLaw);
  if (admitted.hold != ContactHold::observer)
    limiter.limit(tuning.wall_damping, damping, &HapticTuning::wall_damping, kCountDampingLaw);
  limiter.limit(tuning.wall_stiffness, lighter_mass(spec) / (stop_time * stop_time), &HapticTuning::wall_stiffness,
                kCountStiffnessLaw);
}

// Limits the stiffness to what the guard's slew limit can follow. If the force lags behind a contact, it also falls too
// late, and the wall adds energy.
void limit_to_slew(const HapticConfig& config, AdmittedTuning& admitted, const Limiter& limiter) {
  limiter.limit(admitted.tuning.wall_stiffness, config.guard.slew / (period_s(config) * kFastImpact),
                &HapticTuning::wall_stiffness, kSlewLaw);
}

// Sets the damping of the observer hold, which does not depend on what is wanted, except with allow_unstable.
void set_observed_damping(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted) {
  double& damping = admitted.tuning.wall_damping;
  const double needed = observed_damping(lighter_mass(spec), lag(config, spec));
  if (admitted.hold != ContactHold::observer || damping == needed) return;
  const double used = config.contact.allow_unstable ? damping : needed;
  admitted.limits.push_back({kObservedDampingLaw, &HapticTuning::wall_damping, damping, used, needed, {}});
  damping = used;
}

// Time [s] in the law B >= K time of a sampled hold, below which a slow impact gains energy. An encoder count q changes the
// wall's force by K q, so damping must make as much at kDampedImpact; dry friction of K q / 2 does the same to a lever at
// rest (N. Diolaiti et al. Stability of Haptic Rendering: Discretization, Quantization, Time Delay, and Coulomb Effects.
// 2006). The rest of the time, which was found by search, is for late forces.
double least_damping_time(const HapticConfig& config, const DeviceSpec& spec, ContactHold hold) noexcept {
  if (hold == ContactHold::observer) return 0.0;
  const double held = hold == ContactHold::zero_order ? (2 * spec.delay + 1) * period_s(config) : 0.0;
  return spec.position_step / kDampedImpact + 0.1 * lag(config, spec) + held;
}

const char* least_damping_law(ContactHold hold) noexcept {
  return hold == ContactHold::zero_order ? kZeroOrderDampingLaw : kMinDampingLaw;
}

// Raises the damping of a sampled hold to what the loop's stiffness needs, as far as the laws above allow. Returns it, also
// where allow_unstable keeps the damping as it is.
double raise_damping(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                     const Limiter& limiter) {
  double& damping = admitted.tuning.wall_damping;
  const double stiffness = std::min(admitted.tuning.wall_stiffness, loop_stiffness(config.tuning, spec));
  const double needed = stiffness * least_damping_time(config, spec, admitted.hold) - usable_wall_damping(spec);
  const double raised = std::min({needed, quiet_damping(config, spec), count_damping(config, spec)});
  limiter.raise(damping, raised, &HapticTuning::wall_damping, least_damping_law(admitted.hold));
  return std::max(damping, raised);
}

// Limits the stiffness of a sampled hold to what `damping` allows.
void limit_to_damping(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted, double damping,
                      const Limiter& limiter) {
  const double time = least_damping_time(config, spec, admitted.hold);
  if (time == 0.0 || is_on_fast_spring(config, spec)) return;
  if (!config.contact.allow_unstable) damping = admitted.tuning.wall_damping;
  limiter.limit(admitted.tuning.wall_stiffness, (damping + usable_wall_damping(spec)) / time,
                &HapticTuning::wall_stiffness, least_damping_law(admitted.hold));
}

// Calls visit for every axis with every listed hand.
void for_each_lever(const DeviceSpec& spec, const auto& visit) {
  for (const NamedHand& named : kNamedHands)
    for (const AxisModel& axis : {spec.axis_x, spec.axis_y}) visit(axis, named);
}

bool has_device_walls(const DeviceSpec& spec) noexcept {
  return usable_wall_stiffness(spec) > 0.0 || usable_wall_damping(spec) > 0.0;
}

// Calls visit for every axis and hand in a wall, with and without the device wall. To the loop, the device wall acts
// like additional stiffness and damping of the hand.
void for_each_pressed_lever(const DeviceSpec& spec, const auto& visit) {
  for_each_lever(spec, visit);
  if (!has_device_walls(spec)) return;
  for (const NamedHand& named : kNamedHands) {
    for (const int i : {0, 1}) {
      NamedHand pressed = named;
      pressed.hand.stiffness += spec.device_wall_stiffness[i];
      pressed.hand.damping += spec.device_wall_damping[i];
      visit(i == 0 ? spec.axis_x : spec.axis_y, pressed);
    }
  }
}

// The loop's part of the wall while limits are being applied; the device's part is added at the end.
ContactLaw loop_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) {
  ContactLaw law = contact_law(config, admitted, spec);
  law.damping = admitted.tuning.wall_damping;
  return law;
}

// True if the lever is stable with this damping but without the loop's wall stiffness. A lever without damping or
// spring has a spectral radius of exactly 1, which counts as stable here.
bool is_stable_without_wall(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec,
                            double wall_damping) {
  ContactLaw law = loop_law(config, admitted, spec);
  law.hold = ContactHold::zero_order;
  law.stiffness = 0.0;
  law.damping = wall_damping;
  law.free_damping += admitted.tuning.limit_damping;
  double worst = 0.0;
  for_each_pressed_lever(spec, [&](const AxisModel& axis, const NamedHand& named) {
    worst = std::max(worst, spectral_radius(axis, named.hand, law, period_s(config)));
  });
  return worst < 1.0 + 1e-9;
}

void limit_free_damping(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                        const Limiter& limiter) {
  AdmittedTuning trial = admitted;
  double factor = 1.0;
  while (!is_stable_without_wall(config, trial, spec, 0.0) && factor > 1e-3) {
    factor *= 0.5;
    trial.tuning.aisle_damping = factor * admitted.tuning.aisle_damping;
    trial.tuning.limit_damping = factor * admitted.tuning.limit_damping;
  }
  limiter.limit(admitted.tuning.aisle_damping, trial.tuning.aisle_damping, &HapticTuning::aisle_damping, kFreeLaw);
  limiter.limit(admitted.tuning.limit_damping, trial.tuning.limit_damping, &HapticTuning::limit_damping, kFreeLaw);
}

// Limits the damping of the loop's wall on a device that renders walls itself. The loop's damping is delayed, so it can
// destabilise a lever in the device's spring, however soft the loop's own wall is, and add energy long before that.
void limit_damping_with_device_walls(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                                     const Limiter& limiter) {
  if (!has_device_walls(spec) || admitted.hold == ContactHold::observer) return;
  double damping = admitted.tuning.wall_damping;
  while (!is_stable_without_wall(config, admitted, spec, damping) && damping > 1e-3) damping *= 0.5;
  limiter.limit(admitted.tuning.wall_damping, damping, &HapticTuning::wall_damping, kFreeLaw);
  if (is_on_fast_spring(config, spec))
    limiter.limit(admitted.tuning.wall_damping, 0.0, &HapticTuning::wall_damping, fast_spring_law(admitted.hold));
}

// Leaves the wall to the device's springs where the half-sample hold would add energy on them.
void limit_to_device_walls(const HapticConfig& config, const DeviceSpec& spec, AdmittedTuning& admitted,
                           const Limiter& limiter) {
  if (admitted.hold == ContactHold::observer || !is_on_fast_spring(config, spec)) return;
  limiter.limit(admitted.tuning.wall_stiffness, 0.0, &HapticTuning::wall_stiffness, fast_spring_law(admitted.hold));
}

struct StableStiffness {
  double max = std::numeric_limits<double>::infinity();  // [N/m]
  std::string_view hand;                                 // the hand model that sets the limit
};

// True if the lever is stable at `stiffness` and at lower values, down to an eighth of `stiffness`.
bool is_stable_up_to(const AxisModel& axis, const HandImpedance& hand, ContactLaw law, double stiffness,
                     double period) {
  for (law.stiffness = stiffness; law.stiffness > stiffness / 8.0; law.stiffness *= 0.8)
    if (spectral_radius(axis, hand, law, period) >= 1.0) return false;
  return true;
}

// Finds the highest stable stiffness of a spring by this law, outside and above the speed limit. The slow search for a
// limit runs only for a hand that is unstable at the wanted stiffness or at the lowest limit found so far.
StableStiffness stable_stiffness(const HapticConfig& config, const DeviceSpec& spec, ContactLaw law, double wanted,
                                 double limit_damping) {
  StableStiffness stable;
  law.stiffness = kGainMargin * wanted;
  const double slow = law.free_damping, fast = slow + limit_damping;
  for (const double free_damping : {slow, fast}) {
    law.free_damping = free_damping;
    for_each_pressed_lever(spec, [&](const AxisModel& axis, const NamedHand& named) {
      if (stable.max == 0.0 || spectral_radius(axis, named.hand, law, period_s(config)) < 1.0) return;
      const bool is_searched = stable.max < std::numeric_limits<double>::infinity();
      if (is_searched && is_stable_up_to(axis, named.hand, law, kGainMargin * stable.max, period_s(config))) return;
      const double max = stiffness_limit(axis, named.hand, law, period_s(config)) / kGainMargin;
      if (max < stable.max) stable = {max, named.name};
    });
  }
  return stable;
}

// True if the swing of a pressed lever is slower than kFastSwing or shrinks to kSwingDecay in time.
bool has_calm_swing(const AxisModel& axis, const HandImpedance& hand, const ContactLaw& law, double period) {
  const double stiffness = law.stiffness + hand.stiffness + axis.stiffness;
  const double omega = std::sqrt(stiffness / (axis.mass + hand.mass));
  if (omega < 2.0 * std::numbers::pi * kFastSwing) return true;
  const double cycles = kHalfSwings * std::numbers::pi / (omega * period);
  return std::pow(spectral_radius(axis, hand, law, period), cycles) <= kSwingDecay;
}

// Limits the observer hold's stiffness by the swing of the arm, the heaviest listed hand. The observer takes the hand's
// force for constant, so it hardly damps a heavy hand that swings fast.
void limit_swing(const HapticConfig& config, const DeviceSpec& spec, ContactLaw law, AdmittedTuning& admitted,
                 const Limiter& limiter) {
  if (admitted.hold != ContactHold::observer) return;
  const auto is_calm = [&](double stiffness) {
    bool calm = true;
    law.stiffness = kGainMargin * stiffness;
    for_each_pressed_lever(spec, [&](const AxisModel& axis, const NamedHand& named) {
      if (named.name == kHeaviestHand.name) calm = calm && has_calm_swing(axis, named.hand, law, period_s(config));
    });
    return calm;
  };
  double calm = admitted.tuning.wall_stiffness, wild = calm;
  if (is_calm(calm)) return;
  for (calm = 0.0; wild - calm > kSwingAccuracy * wild;) {
    const double middle = 0.5 * (calm + wild);
    (is_calm(middle) ? calm : wild) = middle;
  }
  limiter.limit(admitted.tuning.wall_stiffness, calm, &HapticTuning::wall_stiffness, kSwingLaw, kHeaviestHand.name);
}

// The feel is evaluated where the hold predicts the proxy, and only the damping outside the walls acts with it.
void limit_feel(const HapticConfig& config, const DeviceSpec& spec, double stiffest, ContactLaw law,
                AdmittedTuning& admitted, const Limiter& limiter) {
  if (stiffest == 0.0) return;
  double& scale = admitted.tuning.feel_scale;
  limiter.limit(scale, admitted.tuning.wall_stiffness / stiffest, &HapticTuning::feel_scale, kFeelLaw);
  law.damping = 0.0;
  const StableStiffness stable = stable_stiffness(config, spec, law, scale * stiffest, 0.0);
  limiter.limit(scale, stable.max / stiffest, &HapticTuning::feel_scale, kStableFeelLaw, stable.hand);
}

// Scales the device walls down if the wanted wall is softer than the device walls.
DeviceSpec scale_device_walls(DeviceSpec spec, const HapticTuning& wanted) noexcept {
  const auto device_fraction = [](double wanted_value, double device_part) {
    return device_part > 0.0 ? std::min(1.0, wanted_value / device_part) : 0.0;
  };
  spec.device_wall_stiffness *= device_fraction(wanted.wall_stiffness, usable_wall_stiffness(spec));
  spec.device_wall_damping *= device_fraction(wanted.wall_damping, usable_wall_damping(spec));
  return spec;
}

// Adds the device's part to the loop's admitted part, and corrects the reported limit to the whole wall. The limit is
// dropped if the whole wall reaches the wanted value.
void add_device_part(AdmittedTuning& admitted, double& value, TuningParameter parameter, double wanted,
                     double device_part, const char* unit) {
  if (device_part == 0.0) return;
  value = std::min(wanted, value + device_part);
  const auto is_same_parameter = [&](const TuningLimit& one) { return one.parameter == parameter; };
  const auto limit = std::find_if(admitted.limits.begin(), admitted.limits.end(), is_same_parameter);
  if (limit == admitted.limits.end()) return;
  limit->wanted = wanted;
  limit->used = value;
  limit->bound += device_part;
  limit->law += "; the device itself renders another " + number_text(device_part) + unit;
  if (limit->bound >= wanted) admitted.limits.erase(limit);
}

// Admits the tuning with the half-sample hold. Used if the observer hold is selected, but cannot be used on this device
// because of `law`.
AdmittedTuning fall_back_to_half_sample(HapticConfig config, const DeviceSpec& device, double feel_stiffness,
                                        const char* law, std::string_view hand) {
  config.contact.hold = ContactHold::half_sample;
  AdmittedTuning fallback = admit_tuning(config, device, feel_stiffness);
  const double from = static_cast<double>(ContactHold::observer), to = static_cast<double>(fallback.hold);
  fallback.limits.push_back({law, kHold, from, to, to, std::string(hand)});
  return fallback;
}

// Rejects options that need allow_unstable.
void check_unstable_options(const HapticConfig& config, const DeviceSpec& spec) {
  if (config.contact.allow_unstable && !spec.simulated)
    throw std::invalid_argument(
        "study = true (Allow unstable) is allowed only with a simulated device, because unstable values are not safe");
  if (config.contact.allow_unstable) return;
  if (config.estimator.window > 1)
    throw std::invalid_argument(
        "window_samples above 1 needs study = true (Allow unstable), because a longer window lets damping destabilise "
        "a wall");
  if (!config.contact.reversal_limiter)
    throw std::invalid_argument(
        "reversal_limiter = false needs study = true (Allow unstable), because only the limiter stops a lever that "
        "chatters");
  if (config.contact.energy_control == EnergyControl::passivity_controller)
    throw std::invalid_argument(
        "energy_control = passivity_controller needs study = true (Allow unstable), because it damps only after the "
        "lever has gained energy");
}

}  // namespace

std::int64_t period_ns(const HapticConfig& config) noexcept {
  return std::llround(1e9 / config.rate);
}

double period_s(const HapticConfig& config) noexcept {
  return 1e-9 * static_cast<double>(period_ns(config));
}

void check_tuning(const HapticTuning& tuning) {
  check_parameters(tuning, "tuning");
}

void check_config(const HapticConfig& config) {
  each_section(config, [](std::string_view section, const auto& part) { check_parameters(part, section); });
}

void check_device(const DeviceSpec& spec) {
  const auto check_vector = [](const char* name, glm::dvec2 value, double max, const char* unit) {
    require_between(name, value.x, 0.0, max, unit);
    require_between(name, value.y, 0.0, max, unit);
  };
  check_vector("max_force of the device", spec.max_force, 1e4, "N");
  check_vector("continuous_force of the device", spec.continuous_force, 1e4, "N");
  check_vector("workspace of the device", spec.workspace, 10.0, "m");
  require_between("yoke_radius of the device", spec.yoke_radius, 0.0, 10.0, "m");
  require_between("position_step of the device", spec.position_step, 0.0, 0.1, "m");
  check_vector("wall_stiffness of the device", spec.device_wall_stiffness, 1e5, "N/m");
  check_vector("wall_damping of the device", spec.device_wall_damping, 1e3, "N s/m");
  require_between("delay of the device", spec.delay, 0, kMaxLoopDelay, "cycles");
  check_parameters(spec.axis_x, "device.axis_x");
  check_parameters(spec.axis_y, "device.axis_y");
}

double loop_stiffness(const HapticTuning& tuning, const DeviceSpec& spec) noexcept {
  return std::max(0.0, tuning.wall_stiffness - usable_wall_stiffness(spec));
}

double device_damping(const HapticTuning& tuning, ContactHold hold, const DeviceSpec& spec) noexcept {
  if (hold == ContactHold::observer) return 0.0;
  return std::min(tuning.wall_damping, usable_wall_damping(spec));
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

AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& device, double feel_stiffness) {
  check_unstable_options(config, device);
  DeviceSpec spec = scale_device_walls(device, config.tuning);
  AdmittedTuning out{config.tuning, select_hold(config, spec), {}};
  if (out.hold == ContactHold::observer && !can_observe(config, spec) && !config.contact.allow_unstable)
    return fall_back_to_half_sample(config, device, feel_stiffness, kCountObserverLaw, {});
  if (out.hold == ContactHold::observer)
    spec.device_wall_damping = glm::dvec2(0.0);  // the observer would attribute the damper's force to the hand
  out.tuning.wall_damping -= usable_wall_damping(spec);
  const Limiter limiter{config.contact.allow_unstable, out.limits};
  limit_to_quiet(config, spec, out, limiter);
  limit_to_resolution(config, spec, out, limiter);
  limit_to_slew(config, out, limiter);
  const double damping = raise_damping(config, spec, out, limiter);
  limit_free_damping(config, spec, out, limiter);
  limit_damping_with_device_walls(config, spec, out, limiter);
  limit_to_damping(config, spec, out, damping, limiter);
  set_observed_damping(config, spec, out);
  const ContactLaw wall = loop_law(config, out, spec);
  const StableStiffness stable =
      stable_stiffness(config, spec, wall, out.tuning.wall_stiffness, out.tuning.limit_damping);
  if (stable.max == 0.0 && !config.contact.allow_unstable) {
    if (out.hold == ContactHold::observer)
      return fall_back_to_half_sample(config, device, feel_stiffness, kObserverLaw, stable.hand);
    if (usable_wall_stiffness(spec) == 0.0)
      throw std::invalid_argument("no wall of any stiffness is stable on this device");
  }
  limiter.limit(out.tuning.wall_stiffness, stable.max, &HapticTuning::wall_stiffness, kStableLaw, stable.hand);
  limit_swing(config, spec, wall, out, limiter);
  limit_feel(config, spec, feel_stiffness, wall, out, limiter);
  limit_to_device_walls(config, spec, out, limiter);
  add_device_part(out, out.tuning.wall_stiffness, &HapticTuning::wall_stiffness, config.tuning.wall_stiffness,
                  usable_wall_stiffness(spec), " N/m");
  add_device_part(out, out.tuning.wall_damping, &HapticTuning::wall_damping, config.tuning.wall_damping,
                  usable_wall_damping(spec), " N s/m");
  return out;
}

const char* to_string(TuningParameter parameter) {
  return parameter == kHold ? "hold" : parameter_of(parameter).key;
}

std::string describe(const TuningLimit& limit) {
  const bool is_hold = limit.parameter == kHold;  // the values of `hold` are enumerators, not numbers
  const auto text = [&](double value) {
    return is_hold ? file_key(static_cast<ContactHold>(value)) : short_text(value);
  };
  std::string what = to_string(limit.parameter);
  if (limit.used == limit.wanted)
    what += " " + text(limit.wanted) + " used anyway; the limit is " + short_text(limit.bound);
  else
    what += (!is_hold && limit.used > limit.wanted ? " raised from " : " limited from ") + text(limit.wanted) + " to " +
            text(limit.used);
  return what + " (" + limit.law + (limit.hand.empty() ? "" : "; hand: " + limit.hand) + ")";
}

}  // namespace gearshift::haptics
