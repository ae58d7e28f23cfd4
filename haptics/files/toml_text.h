// Values as TOML writes them.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace gearshift {

// The shortest that reads back to the bit, whatever the locale.
std::string toml_number(auto value) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// A basic string: quotes and backslashes are escaped; control characters are the reader's to refuse.
inline std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace gearshift
