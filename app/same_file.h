// Whether two names mean one file, which is how a file is kept from being written over.
#pragma once

#include <filesystem>
#include <system_error>

namespace gearshift {

// Where it is or would be made, without links; empty where nobody can say.
inline std::filesystem::path place_of(std::filesystem::path file) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(file, error) && links < kMostLinks; ++links)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  file = std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  return error ? std::filesystem::path() : file;
}

// By whatever names and links, there already or not yet. What is no file (/dev/null) may be named for anything.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const std::filesystem::path place = place_of(a);
  return !place.empty() && place == place_of(b);
}

}  // namespace gearshift
