// Every number of the haptic cycle, and what a device admits of it.
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

namespace gearshift {

// What may change while the loop runs. Applied whole, between two cycles, and recorded.
struct HapticTuning {
  double wall_stiffness = 5000.0;  // [N/m] 0 to 20000, of the whole wall: what the device keeps itself included
  double wall_damping = 10.0;      // [N s/m] 0 to 100
  double feel_scale = 1.0;         // [1] 0 to 4, of the gate's feel
  double aisle_damping = 2.0;      // [N s/m] 0 to 50, everywhere
  double speed_limit = 0.6;        // [m/s] 0.05 to 5: above it the aisles resist
  double limit_damping = 15.0;     // [N s/m] 0 to 50, of the speed above the limit
  bool operator==(const HapticTuning&) const = default;
};

struct OverPushConfig {
  double warn_above = 60.0;   // [N] 1 to 1000, the hand's push
  double clear_below = 50.0;  // [N] 0 to warn_above
};

// How a contact is made. Fixed while the loop runs.
struct ContactConfig {
  ContactHold hold = ContactHold::automatic;
  EnergyControl energy_control = EnergyControl::none;  // on top of that hold; passivity_controller in a study only
  bool reversal_limiter = true;                        // false in a study only
  bool study = false;  // nothing is limited to what is stable: simulated devices only, a person must not touch it
};

struct HapticConfig {
  double rate = 1000.0;  // [Hz] 100 to 4000
  HapticTuning tuning;
  ContactConfig contact;
  EstimatorConfig estimator;
  GuardConfig guard;
  OverPushConfig over_push;
  double gear_debounce = 0.010;  // [s] 0 to 0.5
  double ghost_offset = 0.020;   // [m] 0 to 1, lever this far from its proxy: the picture shows the true hand
};

// One thing that was not admitted as wanted. In a study it is told and used all the same.
struct Limited {
  std::string law;   // why, as one formula
  std::string what;  // the parameter
  double wanted = 0.0, used = 0.0;
  double bound = 0.0;  // the most that the law admits
  std::string hand;    // that decides; empty where none does
};

struct AdmittedTuning {
  HapticTuning tuning;
  ContactHold hold = ContactHold::half_sample;  // never automatic
  std::vector<Limited> limited;
};

std::int64_t period_ns(const HapticConfig& config) noexcept;  // of one cycle, a whole number
double period_s(const HapticConfig& config) noexcept;         // the same

// Throw std::invalid_argument with one sentence: parameter, value and allowed range.
void check_tuning(const HapticTuning& tuning);
void check_config(const HapticConfig& config);

void check_device(const DeviceSpec& spec);

// What holds of the wanted tuning, on this device, with every listed hand, the bare handle included:
//   quiet      K <= 0.35 m / tau^2 (observer: 0.58) and B <= 0.35 m / tau, tau = (delay + 1) T, m the lighter axis:
//              found by a search over hands, impact phases, quantisation, jitter and plant error
//   stable     the spectral radius of the sampled cycle (sampled_loop.h) is below 1 on both axes: in the wall at 1.1 K,
//              with the aisles' damping and with that of the speed limit, too; and in free space with both
//   feel       no feel stiffer than the wall that carries the proxy
// Where the device keeps walls itself (DeviceSpec::own_stiffness, own_damping), the loop makes what is left of what is
// wanted, and the laws hold of that part; the exact check sees every lever with the device's spring and damper and without
// them. Limited tells the whole wall, and the device's share of it in the law. Feel is the loop's alone: its bound is what
// the laws admit of the loop. The observer's wall has no damper of the device's: it would take that for the hand's.
// An observed hold has a damping of kObservedDamping at least. In a study all is used as wanted, and told.
// Throws std::invalid_argument for what only a study may have, for a study on a device that is not simulated, and where
// no wall of any stiffness is stable.
AdmittedTuning admit_tuning(const HapticConfig& config, const DeviceSpec& spec, const Gate& gate);

// [N/m] Of the wall, what the loop makes: the rest beside what the device keeps itself.
double loop_stiffness(const HapticTuning& tuning, const DeviceSpec& spec) noexcept;

// [N s/m] Of the wall, what the device damps itself: none where the observer holds it.
double device_damping(const HapticTuning& tuning, ContactHold hold, const DeviceSpec& spec) noexcept;

// What the loop presses the lever back with in the wall under that tuning: for spectral_radius().
ContactLaw contact_law(const HapticConfig& config, const AdmittedTuning& admitted, const DeviceSpec& spec) noexcept;

}  // namespace gearshift
