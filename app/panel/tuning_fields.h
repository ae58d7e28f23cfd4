// What can be tuned while the loop runs: name, unit and range, once for sliders, answers and comparisons.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "haptics/loop/haptic_config.h"

namespace gearshift {

struct TuningField {
  const char* label;
  std::string_view key;  // as files and admit_tuning() name it
  const char* unit;
  double HapticTuning::*member;
  double least, most;  // what check_tuning() takes
  int decimals;
  const char* says;
};

inline constexpr std::array<TuningField, 6> kTuningFields{{
    {"Wall stiffness", "wall_stiffness_n_per_m", "N/m", &HapticTuning::wall_stiffness, 0.0, 20000.0, 0,
     "Force per depth of the lever behind a wall."},
    {"Wall damping", "wall_damping_n_s_per_m", "N s/m", &HapticTuning::wall_damping, 0.0, 100.0, 1,
     "Force per speed into a wall, inside it only."},
    {"Feel", "feel_scale", "\u00d7", &HapticTuning::feel_scale, 0.0, 4.0, 2,
     "Scales the gate's own forces: centring, mouth bump, detent, lock, buffer."},
    {"Aisle damping", "aisle_damping_n_s_per_m", "N s/m", &HapticTuning::aisle_damping, 0.0, 50.0, 1,
     "Force per speed, everywhere."},
    {"Speed limit", "speed_limit_m_per_s", "m/s", &HapticTuning::speed_limit, 0.05, 5.0, 2,
     "Above this speed the aisles resist."},
    {"Limit damping", "limit_damping_n_s_per_m", "N s/m", &HapticTuning::limit_damping, 0.0, 50.0, 1,
     "Force per speed above the speed limit."},
}};

// Index into kTuningFields, or its size.
std::size_t tuning_field(std::string_view key) noexcept;

}  // namespace gearshift
