// Formatting values as TOML.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace gearshift::haptics {

// The shortest text that reads back to the same value, independent of the locale.
std::string toml_number(auto value) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// A basic string with quotes and backslashes escaped. Control characters are not handled; the reader rejects them.
inline std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace gearshift::haptics
