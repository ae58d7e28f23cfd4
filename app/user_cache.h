// Files that may vanish: made again when they are missing.
#pragma once

#include <filesystem>
#include <string_view>

namespace gearshift {

// In $XDG_CACHE_HOME/gearshift, or ~/.cache/gearshift; made where missing. Empty where neither can be had.
std::filesystem::path user_cache_file(std::string_view name);

}  // namespace gearshift
