#include "app/lessons/history/utc_time.h"

#include <array>
#include <chrono>
#include <ctime>

namespace gearshift::lessons {
namespace {

constexpr const char* kFormat = "%Y-%m-%dT%H:%M:%SZ";

}  // namespace

std::int64_t system_seconds() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string format_utc(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm utc{};
  gmtime_r(&time, &utc);
  std::array<char, 40> text{};  // room for a year with ten digits and a sign
  return {text.data(), std::strftime(text.data(), text.size(), kFormat, &utc)};
}

std::optional<std::int64_t> parse_utc(std::string_view date) {
  const std::string text(date);
  std::tm utc{};
  if (strptime(text.c_str(), kFormat, &utc) == nullptr) return std::nullopt;
  const std::int64_t seconds = timegm(&utc);
  if (format_utc(seconds) != text) return std::nullopt;
  return seconds;
}

}  // namespace gearshift::lessons
