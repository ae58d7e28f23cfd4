// A file that is written must not be one that is read, nor another one that is written.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

namespace gearshift {

// By whatever names and links, there already or not yet. What is no file (/dev/null) may be named for anything.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const auto whole = [&](const auto& path) { return weakly_canonical(absolute(path, error), error); };
  return !a.empty() && !b.empty() && whole(a) == whole(b);
}

// option: that names the file to be written; who: both, "the drawing and the layout". Throws CLI::ValidationError.
inline void check_two_files(const std::string& option, const std::string& who, const std::filesystem::path& written,
                            const std::filesystem::path& other) {
  if (is_same_file(written, other)) throw CLI::ValidationError(option, who + " must be two files");
}

}  // namespace gearshift
