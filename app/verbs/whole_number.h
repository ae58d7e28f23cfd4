// A check of seeds and counts, which CLI alone reads as C does: of -1 it makes 2^64 - 1, of 010 eight.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift {

inline constexpr std::uint64_t kMostWhole = 999'999'999'999'999;  // every double tells it from its neighbours

// most: kMostWhole or less.
inline CLI::Validator whole_number(std::uint64_t least = 0, std::uint64_t most = kMostWhole) {
  const auto check = [least, most](std::string& text) {
    const bool is_whole = text == "0" || (!text.empty() && text.size() <= 15 && text.front() != '0' &&
                                          text.find_first_not_of("0123456789") == std::string::npos);
    const bool is_it = is_whole && std::stoull(text) >= least && std::stoull(text) <= most;
    return is_it ? std::string{} : fmt::format("\"{}\" is not a whole number from {} to {}", text, least, most);
  };
  return CLI::Validator(check, fmt::format("{} TO {}", least, most));
}

}  // namespace gearshift
