// Parameters that are fixed while the loop runs, with name, unit and range, for sliders and comparisons.
#pragma once

#include <array>

#include "haptics/loop/haptic_config.h"

namespace gearshift::ui {

struct SetupField {
  const char* key;
  const char* label;
  const char* unit;
  double factor;    // displayed value divided by the value in SI units
  double min, max;  // range that check_config() accepts, in SI units
  int decimals;
  bool logarithmic;
  double (*get)(const haptics::HapticConfig&);
  void (*set)(haptics::HapticConfig&, double);
};

// Initialises getter and setter for a floating-point or integer member of HapticConfig.
#define GEARSHIFT_SETUP(path)                                    \
  [](const haptics::HapticConfig& c) { return double(c.path); }, \
      [](haptics::HapticConfig& c, double v) { c.path = static_cast<decltype(c.path)>(v); }

inline constexpr std::array<SetupField, 15> kSetupFields{{
    {"rate_hz", "Rate", "Hz", 1.0, 100.0, 4000.0, 0, true, GEARSHIFT_SETUP(rate)},
    {"smoothing_s", "Velocity filter", "ms", 1e3, 1e-5, 1.0, 2, true, GEARSHIFT_SETUP(estimator.smoothing)},
    {"speed_limit_m_per_s", "Max plausible speed", "m/s", 1.0, 0.1, 1000.0, 1, true,
     GEARSHIFT_SETUP(estimator.speed_limit)},
    {"window_samples", "Velocity window", "samples", 1.0, 1.0, 64.0, 0, false, GEARSHIFT_SETUP(estimator.window)},
    {"slew_n_per_cycle", "Slew limit", "N/cycle", 1.0, 2.0, 100.0, 1, false, GEARSHIFT_SETUP(guard.slew)},
    {"ramp_time_s", "Ramp to full force", "s", 1.0, 0.001, 60.0, 3, true, GEARSHIFT_SETUP(guard.ramp_time)},
    {"stale_time_s", "Stale after", "ms", 1e3, 0.001, 1.0, 0, true, GEARSHIFT_SETUP(guard.stale_time)},
    {"fade_time_s", "Fade-out", "ms", 1e3, 0.001, 1.0, 0, true, GEARSHIFT_SETUP(guard.fade_time)},
    {"overruns_in_row", "Overruns in a row", "cycles", 1.0, 1.0, 1000.0, 0, true,
     GEARSHIFT_SETUP(guard.overruns_in_row)},
    {"damped_damping_n_s_per_m", "Fallback damping", "N s/m", 1.0, 0.0, 50.0, 1, false,
     GEARSHIFT_SETUP(guard.damped_damping)},
    {"position_margin_m", "Travel margin", "mm", 1e3, 0.0, 1.0, 0, false, GEARSHIFT_SETUP(guard.position_margin)},
    {"warn_above_n", "Over-push begins", "N", 1.0, 1.0, 1000.0, 0, true, GEARSHIFT_SETUP(over_push.warn_above)},
    {"clear_below_n", "Over-push ends", "N", 1.0, 0.0, 1000.0, 0, false, GEARSHIFT_SETUP(over_push.clear_below)},
    {"gear_debounce_s", "Gear debounce", "ms", 1e3, 0.0, 0.5, 0, false, GEARSHIFT_SETUP(gear_debounce)},
    {"ghost_offset_m", "Past wall beyond", "mm", 1e3, 0.0, 1.0, 0, false, GEARSHIFT_SETUP(ghost_offset)},
}};
#undef GEARSHIFT_SETUP

}  // namespace gearshift::ui
