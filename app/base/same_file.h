// Checks whether two paths name the same file, so that an input is not overwritten.
#pragma once

#include <filesystem>
#include <system_error>

#include "haptics/files/resolve_path.h"

namespace gearshift::base {

// Follows links and also works for files that do not exist yet. Always false if the path names something other than a
// regular file, such as /dev/null, which may be given more than once.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const std::filesystem::path place = haptics::resolve_path(a);
  return !place.empty() && place == haptics::resolve_path(b);
}

}  // namespace gearshift::base
