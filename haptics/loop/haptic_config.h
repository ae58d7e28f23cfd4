// All parameters of the haptic cycle, and the limits that a device sets for them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/haptic_device.h"
#include "haptics/gate/gate.h"
#include "haptics/safety/energy_control.h"
#include "haptics/safety/force_guard.h"

namespace gearshift::haptics {

// Parameters that may change while the loop runs. They are applied together, between two cycles, and recorded.
struct HapticTuning {
  double wall_stiffness = 5000.0;  // [N/m] 0 to 20000, whole wall including the device wall
  double wall_damping = 10.0;      // [N s/m] 0 to 100
  double feel_scale = 1.0;         // [1] 0 to 4, factor on the gate's feel
  double aisle_damping = 2.0;      // [N s/m] 0 to 50, acts at every position
  double speed_limit = 0.6;        // [m/s] 0.05 to 5; limit_damping acts above this speed
  double limit_damping = 15.0;     // [N s/m] 0 to 50, multiplies the speed above speed_limit
  bool operator==(const HapticTuning&) const = default;
};

struct OverPushConfig {
  double warn_above = 60.0;   // [N] 1 to 1000; the user is warned if the hand pushes harder than this
  double clear_below = 50.0;  // [N] 0 to warn_above; the warning ends below this push
};

// How wall contacts are rendered. Fixed while the loop runs.
struct ContactConfig {
  ContactHold hold = ContactHold::automatic;
  // Limits the energy of a contact, in addition to `hold`. The value `passivity_controller` needs `allow_unstable`.
  EnergyControl energy_control = EnergyControl::none;
  bool reversal_limiter = true;  // false needs allow_unstable
  bool allow_unstable = false;   // does not limit parameters to the stable range; only for simulated devices
};

struct HapticConfig {
  double rate = 1000.0;  // [Hz] 100 to 4000
  HapticTuning tuning;
  ContactConfig contact;
  EstimatorConfig estimator;
  GuardConfig guard;
  OverPushConfig over_push;
  double gear_debounce = 0.010;  // [s] 0 to 0.5
  double ghost_offset = 0.020;   // [m] 0 to 1; the true hand is drawn if lever and proxy are further apart than this
};

// Parameters that a check may lower, raise or replace.
enum class TuningParameter : std::uint8_t {
  wall_stiffness,
  wall_damping,
  feel_scale,
  aisle_damping,
  limit_damping,
  hold
};
const char* to_string(TuningParameter parameter) noexcept;  // key in files, such as "wall_stiffness_n_per_m"

// A parameter that was limited. With `allow_unstable`, the limit is reported but not applied.
struct TuningLimit {
  std::string law;  // the rule that sets the limit, as text for the user
  TuningParameter parameter = TuningParameter::wall_stiffness;
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
//   quiet      Stiffness K <= 0.35 m / tau^2 (observer hold: 0.58) and damping B <= 0.35 m / tau, with the mass m of
//              the lighter axis and the lag tau = (delay + 1) * period. The factors were found by a search over hands,
//              impact phases, quantisation, jitter and plant error.
//   stable     The spectral radius of the sampled cycle (sampled_loop.h) is below 1 on both axes: in the wall at 1.1 K
//              with `aisle_damping`, with and without `limit_damping`; in free space with both dampings.
//   feel       The gate's feel is no stiffer than the wall that carries the proxy.
//
// If the device renders walls itself (DeviceSpec::device_wall_stiffness, device_wall_damping), the loop renders the
// remaining stiffness and damping, and the laws apply to the loop's part. The stability check covers every
// combination of axis and hand, with and without the device's spring and damper. A TuningLimit gives the values of the
// whole wall, and its text `law` states how much of it the device renders. Only the loop renders feel, so feel is limited to the stiffness that the laws allow the loop. The
// observer hold does not use the device damper, because the observer would attribute the damper's force to the hand.
// The observer hold's damping is at least kMinObserverDamping.
//
// With allow_unstable, limits are reported but not applied. Throws std::invalid_argument for options that need
// allow_unstable, for allow_unstable on a real device, and if no wall of any stiffness is stable.
AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& spec, const Gate& gate);

// [N/m] The loop's part of the wall: the whole stiffness minus the device wall's.
double loop_stiffness(const HapticTuning& tuning, const DeviceSpec& spec) noexcept;

// [N s/m] The device damper's part of the wall's damping; 0 with the observer hold.
double device_damping(const HapticTuning& tuning, ContactHold hold, const DeviceSpec& spec) noexcept;

// The loop's part of the wall under the admitted tuning, as input to spectral_radius().
ContactLaw contact_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) noexcept;

}  // namespace gearshift::haptics
