// Ensures that an output file is neither an input nor another output.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "app/base/same_file.h"

namespace gearshift::verbs {

// Throws CLI::ValidationError if both paths name the same file. `option`: the option that names the output. `both`:
// description of the two files for the message, such as "the drawing and the layout".
inline void check_distinct_outputs(const std::string& option, const std::string& both,
                                   const std::filesystem::path& written, const std::filesystem::path& other) {
  if (base::is_same_file(written, other)) throw CLI::ValidationError(option, both + " must be different files");
}

}  // namespace gearshift::verbs
