// Checks whether two paths name the same file, so that an input is not overwritten.
#pragma once

#include <filesystem>
#include <system_error>

#include "haptics/files/resolve_path.h"

namespace gearshift::base {

// Follows links. Also works for files that do not exist yet. Returns false for anything but regular files, so that for
// example /dev/null may be given more than once.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const std::filesystem::path place = haptics::resolve_path(a);
  return !place.empty() && place == haptics::resolve_path(b);
}

}  // namespace gearshift::base
