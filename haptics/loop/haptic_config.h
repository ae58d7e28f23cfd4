// Every number of the haptic cycle, and what a device admits of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/contact/lever_estimator.h"
#include "haptics/device/haptic_device.h"
#include "haptics/gate/gate.h"
#include "haptics/safety/force_guard.h"

namespace gearshift {

// What may change while the loop runs. Applied whole, between two cycles, and recorded.
struct HapticTuning {
  double wall_stiffness = 5000.0;  // [N/m] 0 to 20000
  double wall_damping = 10.0;      // [N s/m] 0 to 100
  double feel_scale = 1.0;         // [1] 0 to 4, of the gate's feel
  double aisle_damping = 2.0;      // [N s/m] 0 to 50, everywhere
  double speed_limit = 0.6;        // [m/s] 0.05 to 5: above it the aisles resist
  double limit_damping = 15.0;     // [N s/m] 0 to 50, of the speed above the limit
};

struct OverPushConfig {
  double warn_above = 60.0;   // [N] 1 to 1000, the hand's push
  double clear_below = 50.0;  // [N] 0 to warn_above
};

struct HapticConfig {
  double rate = 1000.0;  // [Hz] 100 to 4000
  HapticTuning tuning;
  EstimatorConfig estimator;
  GuardConfig guard;
  OverPushConfig over_push;
  double gear_debounce = 0.010;  // [s] 0 to 0.5
  double ghost_offset = 0.020;   // [m] 0 to 1, lever this far from its proxy: the picture shows the true hand
};

// One thing that was not admitted as wanted.
struct Limited {
  std::string law;   // why, as one formula
  std::string what;  // the parameter
  double wanted = 0.0, used = 0.0;
};

struct AdmittedTuning {
  HapticTuning tuning;
  std::vector<Limited> limited;
};

std::int64_t period_ns(const HapticConfig& config) noexcept;  // of one cycle, a whole number
double period_s(const HapticConfig& config) noexcept;         // the same

// Throw std::invalid_argument with one sentence: parameter, value and allowed range.
void check_tuning(const HapticTuning& tuning);
void check_config(const HapticConfig& config);

// The tuning that holds on this device at this rate with this gate: the delay-scaled stiffness and damping of the
// half-sample hold, K <= 0.35 m / tau^2 and B <= 0.35 m / tau, tau = (delay + 1) T, m the lighter axis. The factor
// was found by a search over hands, impact phases, quantisation, jitter and plant error (400 runs per setting).
AdmittedTuning admit_tuning(const HapticTuning& wanted, double period, const DeviceSpec& spec, const Gate& gate);

}  // namespace gearshift
