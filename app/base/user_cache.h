// Cache files: may be deleted at any time and are created again when missing.
#pragma once

#include <filesystem>
#include <string_view>

namespace gearshift::base {

// A file in $XDG_CACHE_HOME/gearshift or ~/.cache/gearshift; the folder is created if missing. Empty if neither is
// available.
std::filesystem::path user_cache_file(std::string_view name);

}  // namespace gearshift::base
