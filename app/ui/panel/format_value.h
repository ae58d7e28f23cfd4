// Numbers with their unit, as the panel prints them.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/ui/panel/tuning_fields.h"

namespace gearshift::ui {

// Rounds to `decimals` decimal places; adding 0.0 removes the sign of a negative zero.
inline double round_as_printed(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;
}

inline std::string format_value(double value, const char* unit, int decimals) {
  return fmt::format("{:.{}f} {}", round_as_printed(value, decimals), decimals, unit);
}
inline std::string format_value(double value, const TuningField& field) {
  return format_value(value, field.unit, field.decimals);
}

}  // namespace gearshift::ui
