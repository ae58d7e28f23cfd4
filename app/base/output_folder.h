#pragma once

#include <filesystem>

namespace gearshift::base {

// Creates the folder and its parents if they are missing. Throws std::runtime_error with a one-sentence message.
void make_folder(const std::filesystem::path& folder);

}  // namespace gearshift::base
