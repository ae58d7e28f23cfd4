// What is fixed while the loop runs: name, unit and range, once for sliders and comparisons.
#pragma once

#include <array>

#include "haptics/loop/haptic_config.h"

namespace gearshift {

struct SetupField {
  const char* key;
  const char* label;
  const char* unit;
  double factor;       // shown = factor x SI
  double least, most;  // SI; what check_config() takes
  int decimals;
  bool logarithmic;
  double (*get)(const HapticConfig&);
  void (*set)(HapticConfig&, double);
};

// A member that is a double, or a whole number.
#define GEARSHIFT_SETUP(path)                           \
  [](const HapticConfig& c) { return double(c.path); }, \
      [](HapticConfig& c, double v) { c.path = static_cast<decltype(c.path)>(v); }

inline constexpr std::array<SetupField, 15> kSetupFields{{
    {"rate_hz", "Rate", "Hz", 1.0, 100.0, 4000.0, 0, true, GEARSHIFT_SETUP(rate)},
    {"smoothing_s", "Velocity filter", "ms", 1e3, 1e-5, 1.0, 2, true, GEARSHIFT_SETUP(estimator.smoothing)},
    {"speed_limit_m_per_s", "Believed up to", "m/s", 1.0, 0.1, 1000.0, 1, true, GEARSHIFT_SETUP(estimator.speed_limit)},
    {"window_samples", "Velocity over", "samples", 1.0, 1.0, 64.0, 0, false, GEARSHIFT_SETUP(estimator.window)},
    {"slew_n_per_cycle", "Slew", "N/cycle", 1.0, 2.0, 100.0, 1, false, GEARSHIFT_SETUP(guard.slew)},
    {"ramp_time_s", "Ramp to full force", "s", 1.0, 0.001, 60.0, 3, true, GEARSHIFT_SETUP(guard.ramp_time)},
    {"stale_time_s", "Stale after", "ms", 1e3, 0.001, 1.0, 0, true, GEARSHIFT_SETUP(guard.stale_time)},
    {"fade_time_s", "Fade", "ms", 1e3, 0.001, 1.0, 0, true, GEARSHIFT_SETUP(guard.fade_time)},
    {"overruns_in_row", "Late in a row", "cycles", 1.0, 1.0, 1000.0, 0, true, GEARSHIFT_SETUP(guard.overruns_in_row)},
    {"damped_damping_n_s_per_m", "Damping left", "N s/m", 1.0, 0.0, 50.0, 1, false,
     GEARSHIFT_SETUP(guard.damped_damping)},
    {"position_margin_m", "Margin of travel", "mm", 1e3, 0.0, 1.0, 0, false, GEARSHIFT_SETUP(guard.position_margin)},
    {"warn_above_n", "Over-push above", "N", 1.0, 1.0, 1000.0, 0, true, GEARSHIFT_SETUP(over_push.warn_above)},
    {"clear_below_n", "Over-push ends", "N", 1.0, 0.0, 1000.0, 0, false, GEARSHIFT_SETUP(over_push.clear_below)},
    {"gear_debounce_s", "Gear debounce", "ms", 1e3, 0.0, 0.5, 0, false, GEARSHIFT_SETUP(gear_debounce)},
    {"ghost_offset_m", "Ghost beyond", "mm", 1e3, 0.0, 1.0, 0, false, GEARSHIFT_SETUP(ghost_offset)},
}};
#undef GEARSHIFT_SETUP

}  // namespace gearshift
