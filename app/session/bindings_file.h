// Finds bindings by name. The user's own, measured by `devices --calibrate`, are preferred over the shipped ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/base/assets_path.h"
#include "app/ui/input/bindings.h"

namespace gearshift::session {

inline constexpr std::string_view kOwnBindings = "own";

// Empty name: the user's own bindings if there are any, else "default". config_folder: the user's, or empty if there is
// none. Throws std::runtime_error with one sentence.
inline std::filesystem::path bindings_file(const std::string& name, const std::filesystem::path& config_folder) {
  std::filesystem::path own = ui::user_bindings_file(config_folder, std::string(kOwnBindings));
  std::error_code ignored;
  const bool has_own = !config_folder.empty() && std::filesystem::exists(own, ignored);
  if (has_own && (name.empty() || name == kOwnBindings)) return own;
  return base::find_asset("bindings", name.empty() ? "default" : name);
}

}  // namespace gearshift::session
