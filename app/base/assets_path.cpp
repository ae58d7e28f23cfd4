#include "app/base/assets_path.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::base {

namespace fs = std::filesystem;

fs::path assets_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw std::runtime_error(fmt::format("cannot read /proc/self/exe: {}", error.message()));
  return program.parent_path().parent_path() / "share" / "gearshift" / "assets";
}

std::vector<std::string> shipped_names(std::string_view kind) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(assets_folder() / kind, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path shipped_folder(std::string_view kind) {
  std::error_code error;
  if (!fs::is_directory(assets_folder() / kind, error))
    throw std::runtime_error(
        fmt::format("{}: the program's data files (gates, cars, lessons, models) are missing; "
                    "reinstall gearshift",
                    haptics::printable(assets_folder().string())));
  return assets_folder() / kind;
}

fs::path find_asset(std::string_view kind, const std::string& name_or_path) {
  const auto names = shipped_names(kind);
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return assets_folder() / kind / (name_or_path + ".toml");
  }
  // Return text that looks like a path, or that names an existing file, unchanged. If reading this file fails, that
  // error message is the clearest.
  fs::path path(name_or_path);
  std::error_code error;
  if (path.has_parent_path() || path.has_extension() || fs::exists(path, error)) return path;
  shipped_folder(kind);
  throw std::runtime_error(fmt::format("\"{}\" is neither a file nor one of the shipped {}: {}",
                                       haptics::printable(name_or_path), kind, fmt::join(names, ", ")));
}

}  // namespace gearshift::base
