// Bindings by name: what `devices --calibrate` has learnt of a person's pedals and pads goes before the shipped ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/assets_path.h"
#include "app/input/bindings.h"

namespace gearshift {

inline constexpr std::string_view kOwnBindings = "own";

// Empty: the person's own where there are some, else "default". config_folder: the user's; empty: there is none. Throws std::runtime_error with one sentence.
inline std::filesystem::path bindings_file(const std::string& name, const std::filesystem::path& config_folder) {
  std::filesystem::path own = own_bindings_file(config_folder, std::string(kOwnBindings));
  std::error_code ignored;
  const bool has_own = !config_folder.empty() && std::filesystem::exists(own, ignored);
  if (has_own && (name.empty() || name == kOwnBindings)) return own;
  return find_asset("bindings", name.empty() ? "default" : name);
}

}  // namespace gearshift
