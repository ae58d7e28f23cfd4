// All parameters of the haptic cycle, and the limits that a device sets for them.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/haptic_device.h"
#include "haptics/safety/energy_control.h"
#include "haptics/safety/force_guard.h"

namespace gearshift::haptics {

// Parameters that may change while the loop runs. They are applied together, between two cycles, and recorded.
struct HapticTuning {
  double wall_stiffness = 5000.0;  // [N/m] whole wall including the device wall
  double wall_damping = 10.0;      // [N s/m]
  double feel_scale = 1.0;         // [1] factor on the gate's feel
  double aisle_damping = 2.0;      // [N s/m] acts at every position
  double speed_limit = 0.6;        // [m/s] limit_damping acts above this speed
  double limit_damping = 15.0;     // [N s/m] multiplies the speed above speed_limit
  bool operator==(const HapticTuning&) const = default;
};

template <>
inline constexpr Parameter<HapticTuning> kParameters<HapticTuning>[] = {
    {&HapticTuning::wall_stiffness, "wall_stiffness", "wall_stiffness_n_per_m", FileRange{0.0, 20000.0},
     "Force per metre of penetration into a wall.", "Wall stiffness", "walls are soft",
     "it is limited, or with `study` the lever buzzes", Display{"N/m"}},
    {&HapticTuning::wall_damping, "wall_damping", "wall_damping_n_s_per_m", FileRange{0.0, 100.0},
     "Damping force per m/s of speed into a wall, only during contact.", "Wall damping", "the lever bounces",
     "it hums at the encoder's resolution", Display{"N s/m", 1}},
    {&HapticTuning::feel_scale, "feel_scale", "feel_scale", FileRange{0.0, 4.0},
     "Scales the gate's own forces: centring, mouth bump, detent, lock, buffer.", "Feel", "no detents",
     "walls must be stiffer", Display{"\u00d7", 2}},
    {&HapticTuning::aisle_damping, "aisle_damping", "aisle_damping_n_s_per_m", FileRange{0.0, 50.0},
     "Damping force per m/s of lever speed, everywhere in the gate.", "Aisle damping", "the lever overshoots neutral",
     "it feels viscous", Display{"N s/m", 1}},
    {&HapticTuning::speed_limit, "speed_limit", "speed_limit_m_per_s", FileRange{0.05, 5.0},
     "Above this speed, extra damping (Limit damping) slows the lever.", "Speed limit", "every fast stroke is resisted",
     "none is", Display{"m/s", 2}},
    {&HapticTuning::limit_damping, "limit_damping", "limit_damping_n_s_per_m", FileRange{0.0, 50.0},
     "Extra damping force per m/s above the speed limit.", "Limit damping", "no speed limit", "a kick above it",
     Display{"N s/m", 1}},
};
static_assert(DescribesAll<HapticTuning>);

struct OverPushConfig {
  double warn_above = 60.0;   // [N] the user is warned if the hand pushes harder than this
  double clear_below = 50.0;  // [N] 0 to warn_above; the warning ends below this push
  bool operator==(const OverPushConfig&) const = default;
};

template <>
inline constexpr Parameter<OverPushConfig> kParameters<OverPushConfig>[] = {
    {&OverPushConfig::warn_above, "warn_above", "warn_above_n", FileRange{1.0, 1000.0},
     "A push of the hand above this force is reported as an over-push.", "Over-push begins", "warnings are frequent",
     "none come", Display{"N", 0, 1.0, true}},
    {&OverPushConfig::clear_below, "clear_below", "clear_below_n", FileRange{0.0, 1000.0},
     "The over-push ends when the push falls below this force.", "Over-push ends",
     "the warning stays long after the push", "the warning flickers", Display{"N"}, &OverPushConfig::warn_above},
};
static_assert(DescribesAll<OverPushConfig>);

// How wall contacts are rendered. Fixed while the loop runs.
struct ContactConfig {
  ContactHold hold = ContactHold::automatic;
  // Limits the energy of a contact, in addition to `hold`. The value `passivity_controller` needs `allow_unstable`.
  EnergyControl energy_control = EnergyControl::none;
  bool reversal_limiter = true;  // false needs allow_unstable
  bool allow_unstable = false;   // does not limit parameters to the stable range; only for simulated devices
  bool operator==(const ContactConfig&) const = default;
};

template <>
inline constexpr Parameter<ContactConfig, ContactHold, EnergyControl> kParameters<ContactConfig>[] = {
    {&ContactConfig::hold, "hold", "hold", FileRange{},
     "How the wall force that is held for a cycle is computed from the sampled motion.", "Hold", ""},
    {&ContactConfig::energy_control, "energy_control", "energy_control", FileRange{},
     "Makes any force passive, in addition to the hold; costs stiffness.", "Energy control", "",
     "bounding costs most of the stiffness"},
    {&ContactConfig::reversal_limiter, "reversal_limiter", "reversal_limiter", FileRange{},
     "Reduces the wall stiffness if the lever chatters.", "Reversal limiter"},
    {&ContactConfig::allow_unstable, "study", "study", FileRange{},
     "Uses unstable values as they are set. Simulated levers only.", "Allow unstable"},
};
static_assert(DescribesAll<ContactConfig>);

struct HapticConfig {
  double rate = 1000.0;  // [Hz]
  HapticTuning tuning;
  ContactConfig contact;
  EstimatorConfig estimator;
  GuardConfig guard;
  OverPushConfig over_push;
  double gear_debounce = 0.010;  // [s]
  double ghost_offset = 0.020;   // [m] the true hand is drawn if lever and proxy are further apart than this
  bool operator==(const HapticConfig&) const = default;
};

template <>
inline constexpr Parameter<HapticConfig> kParameters<HapticConfig>[] = {
    {&HapticConfig::rate, "rate", "rate_hz", FileRange{100.0, 4000.0}, "Cycles of the haptic loop per second.", "Rate",
     "walls are soft", "cycles are late", Display{"Hz", 0, 1.0, true}},
    {&HapticConfig::gear_debounce, "gear_debounce", "gear_debounce_s", FileRange{0.0, 0.5},
     "A gear counts as engaged after this time in its slot.", "Gear debounce", "the gear flickers",
     "it is reported late", Display{"ms", 0, 1e3}},
    {&HapticConfig::ghost_offset, "ghost_offset", "ghost_offset_m", FileRange{0.0, 1.0},
     "If lever and proxy are further apart, the picture shows the true position of the hand.", "Past wall beyond",
     "a ghost hand at every wall", "picture and hand differ unnoticed", Display{"mm", 0, 1e3}},
};
static_assert(describes_all(&HapticConfig::tuning, &HapticConfig::contact, &HapticConfig::estimator,
                            &HapticConfig::guard, &HapticConfig::over_push));

// Calls visit(section, part) for each section of a configuration file and the struct that it sets.
template <class Config>
requires std::is_same_v<std::remove_const_t<Config>, HapticConfig>
constexpr void each_section(Config& config, auto&& visit) {
  visit("loop", config);
  visit("tuning", config.tuning);
  visit("contact", config.contact);
  visit("estimator", config.estimator);
  visit("guard", config.guard);
  visit("over_push", config.over_push);
}

// A parameter that a check may lower, raise or replace: a member of HapticTuning, or kHold.
using TuningParameter = double HapticTuning::*;
inline constexpr TuningParameter kHold = nullptr;
const char* to_string(TuningParameter parameter);  // key in files, such as "wall_stiffness_n_per_m"

// A parameter that was limited. With `allow_unstable`, the limit is reported but not applied.
struct TuningLimit {
  std::string law;  // the rule that sets the limit, as text for the user
  TuningParameter parameter = &HapticTuning::wall_stiffness;
  double wanted = 0.0, used = 0.0;
  double bound = 0.0;  // the limit that the law sets
  std::string hand;    // the hand model that sets the limit; empty if the limit depends on no hand
};
// For example "wall_stiffness_n_per_m limited from 5000 to 301 (law; hand: bare)" or "hold limited from observer to
// half_sample"; with `allow_unstable`: "wall_stiffness_n_per_m 5000 used anyway; the limit is 301 (...)".
std::string describe(const TuningLimit& limit);

struct AdmittedTuning {
  HapticTuning tuning;
  ContactHold hold = ContactHold::half_sample;  // never automatic
  std::vector<TuningLimit> limits;
};

std::int64_t period_ns(const HapticConfig& config) noexcept;  // period of one cycle, a whole number [ns]
double period_s(const HapticConfig& config) noexcept;         // the same period [s]

// check_tuning() and check_config() throw std::invalid_argument with one sentence: parameter, value and allowed range.
void check_tuning(const HapticTuning& tuning);
void check_config(const HapticConfig& config);

void check_device(const DeviceSpec& spec);

// Limits the wanted tuning to what works on this device with every hand of kNamedHands, the bare handle included:
//   quiet      Stiffness K <= 0.25 m / tau^2 (observer hold: 0.58, or 0.5 on device springs of more than m / tau^2) and
//              damping B <= 0.35 m / tau (observer hold: exactly 0.7), with the mass m of the lighter axis and the lag tau
//              = (delay + 1) * period. Without the observer, B >= K (q / (0.08 m/s) + 0.1 tau) with the encoder's count q
//              (zero-order hold: and (2 delay + 1) T more), or an impact gains energy: B is raised, and K limited where B
//              cannot be. Above tau = 15 ms an impact gains energy anyway, which is reported. The factors were compared
//              with their neighbours over hands, impact phases, quantisation, jitter and plant error. On device springs k
//              > 0.35 m / tau^2 (zero-order hold: 0.15) a sampled hold would add energy: the observer hold replaces it, or
//              the springs render the whole wall.
//   resolution One encoder count q changes a damping force by at most 3 N (B q / T), and a wall stops a lever of 0.1 m/s
//              within 3 counts or more. If a count changes the observed velocity by more than 0.125 m/s, the half-sample
//              hold replaces the observer, with K <= 0.2 m / tau^2.
//   slew       K <= slew / (T 1 m/s): the force follows a contact at 1 m/s.
//   stable     The spectral radius of the sampled cycle (sampled_loop.h) is below 1 on both axes: in the wall at 1.1 K
//              with `aisle_damping`, with and without `limit_damping`; in free space with both dampings.
//   swing      With the observer hold, the arm's swing above 10 Hz shrinks to a third in seven half-swings at 1.1 K.
//              Otherwise the reversal limiter may take it for chatter.
//   feel       The gate's feel is no stiffer than the wall that carries the proxy.
//
// If the device renders walls itself (DeviceSpec::device_wall_stiffness, device_wall_damping), the loop renders the
// remaining stiffness and damping, and the laws apply to the loop's part. The stability check covers every
// combination of axis and hand, with and without the device's spring and damper. A TuningLimit gives the values of the
// whole wall, and its text `law` states how much of it the device renders. Only the loop renders feel, so feel is limited
// to the stiffness that the laws allow the loop. The observer hold does not use the device damper, because the observer
// would attribute the damper's force to the hand.
//
// With allow_unstable, limits are reported but not applied. Throws std::invalid_argument for options that need
// allow_unstable, for allow_unstable on a real device, and if no wall of any stiffness is stable.
// feel_stiffness: [N/m] max_feel_stiffness() of the gate.
AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& spec, double feel_stiffness);

// [N/m] The loop's part of the wall: the whole stiffness minus the device wall's.
double loop_stiffness(const HapticTuning& tuning, const DeviceSpec& spec) noexcept;

// [N s/m] The device damper's part of the wall's damping; 0 with the observer hold.
double device_damping(const HapticTuning& tuning, ContactHold hold, const DeviceSpec& spec) noexcept;

// The loop's part of the wall under the admitted tuning, as input to spectral_radius().
ContactLaw contact_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) noexcept;

}  // namespace gearshift::haptics
