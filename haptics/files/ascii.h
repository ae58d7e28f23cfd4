// Letters of names and keys without regard to the locale: in a Turkish one std::tolower('I') is no 'i', and GLFW sets it.
#pragma once

namespace gearshift {

constexpr char ascii_lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr char ascii_upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace gearshift
