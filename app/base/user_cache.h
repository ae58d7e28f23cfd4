// Files that the program caches. The user may delete them at any time; a missing file is created again.
#pragma once

#include <filesystem>
#include <string_view>

namespace gearshift::base {

// Returns the path of a file in $XDG_CACHE_HOME/gearshift or ~/.cache/gearshift; creates the folder if it is missing.
// Returns an empty path if neither folder is available.
std::filesystem::path user_cache_file(std::string_view name);

}  // namespace gearshift::base
