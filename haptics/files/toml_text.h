// Formats values as TOML.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace gearshift::haptics {

// The shortest text that is read back as the same value. Independent of the locale.
std::string toml_number(auto value) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// A TOML basic string: quotes and backslashes are escaped. Control characters are written unchanged, and the reader
// rejects them.
inline std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace gearshift::haptics
