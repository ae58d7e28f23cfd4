// Dates as the history writes them: seconds since 1970, and ISO 8601 text such as "2026-01-02T03:04:05Z".
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace gearshift::lessons {

using Clock = std::function<std::int64_t()>;  // returns the UTC time in seconds since 1970

std::int64_t system_seconds();                                 // current time of the system clock
std::string format_utc(std::int64_t seconds);                  // ISO 8601, UTC
std::optional<std::int64_t> parse_utc(std::string_view date);  // empty if the text is not in the format of format_utc()

}  // namespace gearshift::lessons
