// Where a name leads.
#pragma once

#include <filesystem>
#include <system_error>

namespace gearshift {

// From the root; as it is where the working folder is gone.
inline std::filesystem::path absolute_place(const std::filesystem::path& file) {
  std::error_code gone;
  const std::filesystem::path absolute = std::filesystem::absolute(file, gone);
  return gone ? file : absolute;
}

// Where it is or would be made, without links; empty where nobody can say.
inline std::filesystem::path place_of(std::filesystem::path file) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(file, error) && links < kMostLinks; ++links)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  file = std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  return error ? std::filesystem::path() : file;
}

}  // namespace gearshift
