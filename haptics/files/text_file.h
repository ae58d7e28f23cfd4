// Reads a small text file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gearshift::haptics {

inline constexpr std::uintmax_t kMaxTextFile = 1 << 20;  // [bytes] far larger than any hand-written file

// Returns the whole file. Throws FileError if it is missing, not a regular file, unreadable or larger than
// kMaxTextFile.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace gearshift::haptics
