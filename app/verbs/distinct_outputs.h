// Makes sure that an output file is neither an input nor another output.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "app/base/same_file.h"

namespace gearshift::verbs {

// option: the option that names the output. both: what the two files are, "the drawing and the layout".
// Throws CLI::ValidationError if they are the same file.
inline void check_distinct_outputs(const std::string& option, const std::string& both,
                                   const std::filesystem::path& written, const std::filesystem::path& other) {
  if (base::is_same_file(written, other)) throw CLI::ValidationError(option, both + " must be different files");
}

}  // namespace gearshift::verbs
