// A check of seeds and numbers of cases, which CLI alone wraps: of -1 it makes 2^64 - 1.
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift {

// From 0 to 10^15 - 1.
inline CLI::Validator whole_number() {
  const auto check = [](std::string& text) {
    const bool is_whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    return is_whole && text.size() <= 15 ? std::string{}
                                         : fmt::format("\"{}\" is not a whole number from 0 to 999999999999999", text);
  };
  return CLI::Validator(check, "UP TO 999999999999999");
}

}  // namespace gearshift
