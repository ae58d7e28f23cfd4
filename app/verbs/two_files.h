// A file that is written must not be one that is read, nor another one that is written.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "app/same_file.h"

namespace gearshift {

// option: that names the file to be written; who: both, "the drawing and the layout". Throws CLI::ValidationError.
inline void check_two_files(const std::string& option, const std::string& who, const std::filesystem::path& written,
                            const std::filesystem::path& other) {
  if (is_same_file(written, other)) throw CLI::ValidationError(option, who + " must be two files");
}

}  // namespace gearshift
