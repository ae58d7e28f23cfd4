// Converts file names to absolute paths.
#pragma once

#include <filesystem>
#include <system_error>

namespace gearshift::haptics {

// Returns the absolute path; returns `file` unchanged if the working folder no longer exists.
inline std::filesystem::path make_absolute(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(file, error);
  return error ? file : absolute;
}

// Returns the path, without symbolic links, at which the file exists or would be created. Returns an empty path if that
// path cannot be determined.
inline std::filesystem::path resolve_path(std::filesystem::path file) {
  constexpr int kMaxLinks = 40;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(file, error) && links < kMaxLinks; ++links)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  file = std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  return error ? std::filesystem::path() : file;
}

}  // namespace gearshift::haptics
