// Locale-independent case conversion for names and keys: in a Turkish locale std::tolower('I') is not 'i', and GLFW
// sets the locale.
#pragma once

namespace gearshift::haptics {

constexpr char ascii_lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr char ascii_upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace gearshift::haptics
