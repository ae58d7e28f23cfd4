// Numbers with their unit, as the panel prints them.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/panel/tuning_fields.h"

namespace gearshift {

// As so many decimals print it, without a minus before a zero.
inline double as_printed(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;
}

inline std::string value_text(double value, const char* unit, int decimals) {
  return fmt::format("{:.{}f} {}", as_printed(value, decimals), decimals, unit);
}
inline std::string value_text(double value, const TuningField& field) {
  return value_text(value, field.unit, field.decimals);
}

}  // namespace gearshift
