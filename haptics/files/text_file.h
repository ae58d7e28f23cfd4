// A small text file, whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gearshift {

inline constexpr std::uintmax_t kMaxTextFile = 1 << 20;  // [bytes] no human-written file comes near it

// Throws FileError in one sentence: missing, not a file, unreadable, larger than kMaxTextFile.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace gearshift
