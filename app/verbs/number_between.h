// A range check that also refuses NaN, which CLI::Range lets through.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift::verbs {

inline CLI::Validator number_between(double min, double max) {
  const std::string range = fmt::format("{:g} to {:g}", min, max);
  const auto check = [min, max, range](std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool ok = !text.empty() && *end == '\0' && std::isfinite(value) && value >= min && value <= max;
    return ok ? std::string{} : fmt::format("\"{}\" is not a number from {}", text, range);
  };
  return CLI::Validator(check, "FROM " + range);
}

}  // namespace gearshift::verbs
