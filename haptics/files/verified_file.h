// Writing files that people may edit, with a check that the program can read them back.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace gearshift::haptics {

// Writes the text to a temporary file, reads it back with `read`, which throws FileError on failure, and only then
// replaces `file`. Throws FileError naming `file`; its previous content is then unchanged.
void write_verified_file(const std::filesystem::path& file, std::string_view text,
                         const std::function<void(const std::filesystem::path&)>& read);

}  // namespace gearshift::haptics
