// Whether two names mean one file, which is how a file is kept from being written over.
#pragma once

#include <filesystem>
#include <system_error>

#include "haptics/files/place_of.h"

namespace gearshift {

// By whatever names and links, there already or not yet. What is no file (/dev/null) may be named for anything.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const std::filesystem::path place = place_of(a);
  return !place.empty() && place == place_of(b);
}

}  // namespace gearshift
