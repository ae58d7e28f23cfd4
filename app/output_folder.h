#pragma once

#include <filesystem>

namespace gearshift {

// Made where it is missing, its parents too. Throws std::runtime_error in one sentence.
void make_folder(const std::filesystem::path& folder);

}  // namespace gearshift
