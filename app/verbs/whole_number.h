// A check for seeds and counts. It is needed because CLI11 parses numbers like C: it would accept -1 as 2^64 - 1 and
// 010 as 8.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift::verbs {

inline constexpr std::uint64_t kMaxWholeNumber = 999'999'999'999'999;  // below 2^53, so that a double holds it exactly

// Accepts whole numbers from min to max. max must not exceed kMaxWholeNumber.
inline CLI::Validator whole_number(std::uint64_t min = 0, std::uint64_t max = kMaxWholeNumber) {
  const auto check = [min, max](std::string& text) {
    const bool is_whole = text == "0" || (!text.empty() && text.size() <= 15 && text.front() != '0' &&
                                          text.find_first_not_of("0123456789") == std::string::npos);
    const bool is_in_range = is_whole && std::stoull(text) >= min && std::stoull(text) <= max;
    return is_in_range ? std::string{} : fmt::format("\"{}\" is not a whole number from {} to {}", text, min, max);
  };
  return CLI::Validator(check, fmt::format("{} TO {}", min, max));
}

}  // namespace gearshift::verbs
