// The unit in which a car shows road speeds: on its dials, in prompts and in feedback. Files and CSV stay in km/h.
#pragma once

#include <cstdint>

#include "haptics/files/parameter.h"

namespace gearshift::vehicle {

enum class SpeedUnit : std::uint8_t { km_per_h, mph };

constexpr const char* to_string(SpeedUnit unit) noexcept {
  return unit == SpeedUnit::mph ? "mph" : "km/h";
}
constexpr const char* file_key(SpeedUnit unit) noexcept {
  return to_string(unit);
}
constexpr SpeedUnit last_value(SpeedUnit) noexcept {
  return SpeedUnit::mph;
}

inline constexpr double kMphPerMps = 3600.0 / 1609.344;  // the international mile is 1609.344 m

// A road speed [m/s] in this unit.
constexpr double in_unit(SpeedUnit unit, double speed) noexcept {
  return speed * (unit == SpeedUnit::mph ? kMphPerMps : haptics::kKmhPerMps);
}

}  // namespace gearshift::vehicle
