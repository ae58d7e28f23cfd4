// Numbers with their unit, as the panel prints them.
#pragma once

#include <string>

#include <fmt/format.h>

#include "app/panel/tuning_fields.h"

namespace gearshift {

inline std::string value_text(double value, const char* unit, int decimals) {
  return fmt::format("{:.{}f} {}", value, decimals, unit);
}
inline std::string value_text(double value, const TuningField& field) {
  return value_text(value, field.unit, field.decimals);
}

}  // namespace gearshift
