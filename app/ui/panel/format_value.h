// Numbers with their unit, as the panel prints them.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>

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
  return format_value(value, field.display.unit, field.display.decimals);
}

// A parameter's value as the screen shows it.
template <class S, class... Enums, class Value>
std::string format_value(const haptics::Parameter<S, Enums...>& parameter, const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return value ? "yes" : "no";
  } else if constexpr (std::is_enum_v<Value>) {
    return haptics::to_string(value);
  } else {
    const haptics::Display& display = parameter.display;
    return format_value(display.factor * static_cast<double>(value), display.unit, display.decimals);
  }
}

}  // namespace gearshift::ui
