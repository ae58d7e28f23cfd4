// A range check that also rejects NaN, which CLI::Range accepts.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "haptics/files/parameter.h"

namespace gearshift::verbs {

inline CLI::Validator number_between(double min, double max) {
  const auto check = [min, max](std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool ok = !text.empty() && *end == '\0' && std::isfinite(value) && value >= min && value <= max;
    return ok ? std::string{} : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, min, max);
  };
  return CLI::Validator(check, fmt::format("{:g} TO {:g}", min, max));
}

// The range of a parameter, for example &HapticConfig::rate, in the unit of files.
template <class S>
CLI::Validator within_range_of(double S::*parameter) {
  const haptics::FileRange& range = haptics::parameter_of(parameter).range;
  return number_between(range.min, range.max);
}

}  // namespace gearshift::verbs
