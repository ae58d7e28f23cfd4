// A file that a person may edit: what the program writes, the program can read.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace gearshift {

// Written, and read again, before it takes the place of what was there. read: throws FileError where it cannot. Throws
// FileError, which names `file`; then what was there before still is.
void write_readable_file(const std::filesystem::path& file, std::string_view text,
                         const std::function<void(const std::filesystem::path&)>& read);

}  // namespace gearshift
