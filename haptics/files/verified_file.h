// Writes files that users may edit, and checks that the program can read them back.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace gearshift::haptics {

// Writes the text to a temporary file and reads that file with `read`, which must throw FileError if it
// fails. If `read` fails, throws a FileError that names `file`, and leaves `file` unchanged. Otherwise replaces `file`.
void write_verified_file(const std::filesystem::path& file, std::string_view text,
                         const std::function<void(const std::filesystem::path&)>& read);

}  // namespace gearshift::haptics
