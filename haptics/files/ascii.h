// Case conversion for names and keys, independent of the locale. GLFW sets the user's locale, and in a Turkish locale
// std::tolower('I') is not 'i'.
#pragma once

namespace gearshift::haptics {

constexpr char ascii_lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr char ascii_upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace gearshift::haptics
