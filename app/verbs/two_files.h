// A file that is written must not be one that is read, nor another one that is written.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

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

// option: that names the file to be written; who: both, "the drawing and the layout". Throws CLI::ValidationError.
inline void check_two_files(const std::string& option, const std::string& who, const std::filesystem::path& written,
                            const std::filesystem::path& other) {
  if (is_same_file(written, other)) throw CLI::ValidationError(option, who + " must be two files");
}

}  // namespace gearshift
