// Parameters that can be tuned while the loop runs, with name, unit and range, for sliders, checks and comparisons.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "haptics/loop/haptic_config.h"

namespace gearshift::ui {

struct TuningField {
  const char* label;
  std::string_view key;  // the parameter's name in files and in admit_tuning()
  const char* unit;
  double haptics::HapticTuning::*member;
  double min, max;  // range that check_tuning() accepts
  int decimals;
  const char* description;
};

inline constexpr std::array<TuningField, 6> kTuningFields{{
    {"Wall stiffness", "wall_stiffness_n_per_m", "N/m", &haptics::HapticTuning::wall_stiffness, 0.0, 20000.0, 0,
     "Force per metre of penetration into a wall."},
    {"Wall damping", "wall_damping_n_s_per_m", "N s/m", &haptics::HapticTuning::wall_damping, 0.0, 100.0, 1,
     "Damping force per m/s of speed into a wall, only during contact."},
    {"Feel", "feel_scale", "\u00d7", &haptics::HapticTuning::feel_scale, 0.0, 4.0, 2,
     "Scales the gate's own forces: centring, mouth bump, detent, lock, buffer."},
    {"Aisle damping", "aisle_damping_n_s_per_m", "N s/m", &haptics::HapticTuning::aisle_damping, 0.0, 50.0, 1,
     "Damping force per m/s of lever speed, everywhere in the gate."},
    {"Speed limit", "speed_limit_m_per_s", "m/s", &haptics::HapticTuning::speed_limit, 0.05, 5.0, 2,
     "Above this speed, extra damping (Limit damping) slows the lever."},
    {"Limit damping", "limit_damping_n_s_per_m", "N s/m", &haptics::HapticTuning::limit_damping, 0.0, 50.0, 1,
     "Extra damping force per m/s above the speed limit."},
}};

// Index into kTuningFields; the size of kTuningFields if the key is unknown.
std::size_t tuning_field(std::string_view key) noexcept;

}  // namespace gearshift::ui
