// Moments as the history writes them: seconds since 1970, and "2026-01-02T03:04:05Z".
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace gearshift {

using Clock = std::function<std::int64_t()>;  // [s] since 1970, UTC

std::int64_t system_seconds();                                  // the machine's
std::string date_text(std::int64_t seconds);                    // ISO 8601, UTC
std::optional<std::int64_t> seconds_of(std::string_view date);  // nothing for what date_text() does not write

}  // namespace gearshift
