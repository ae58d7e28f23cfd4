// Finds a file of key and button bindings by name. The user's own bindings, measured by `devices --calibrate`, have
// priority over shipped ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/base/assets_path.h"
#include "app/ui/input/bindings.h"

namespace gearshift::session {

inline constexpr std::string_view kOwnBindings = "own";

// For an empty name, returns the user's own bindings if they exist, else "default". `config_folder`: the user's folder;
// empty if the user has none. Throws std::runtime_error with a one-sentence message.
inline std::filesystem::path bindings_file(const std::string& name, const std::filesystem::path& config_folder) {
  std::filesystem::path own = ui::user_bindings_file(config_folder, std::string(kOwnBindings));
  std::error_code ignored;
  const bool has_own = !config_folder.empty() && std::filesystem::exists(own, ignored);
  if (has_own && (name.empty() || name == kOwnBindings)) return own;
  return base::find_asset("bindings", name.empty() ? "default" : name);
}

}  // namespace gearshift::session
