#include "app/session/preset_store.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/output_folder.h"
#include "app/base/user_folders.h"
#include "haptics/files/printable.h"

namespace gearshift::session {
namespace {

namespace fs = std::filesystem;

bool is_shipped(const std::string& name) {
  const std::vector<std::string> shipped = base::shipped_names("presets");
  return std::find(shipped.begin(), shipped.end(), name) != shipped.end();
}

// Folder of the user's presets; empty if there is no home folder.
fs::path user_folder() {
  try {
    return base::user_presets_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

const char* name_problem(const std::string& name) {
  if (name.empty()) return "the name must not be empty";
  if (name.front() == '.') return "the name must not start with a dot";
  if (name.find('/') != std::string::npos) return "the name must not contain a slash";
  return is_shipped(name) ? "a shipped preset already has that name" : nullptr;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names = base::shipped_names("presets"), own;
  std::error_code error;
  for (fs::directory_iterator entry(user_folder(), error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().stem().string();
    if (entry->path().extension() == ".toml" && name_problem(name) == nullptr) own.push_back(name);
  }
  std::sort(own.begin(), own.end());
  names.insert(names.end(), own.begin(), own.end());
  return names;
}

fs::path preset_file(const std::string& name) {
  std::error_code error;
  const fs::path folder = user_folder(), own = folder / (name + ".toml");
  const bool is_own = !folder.empty() && name_problem(name) == nullptr && fs::exists(own, error);
  return is_own ? own : base::find_asset("presets", name);
}

fs::path user_preset_file(const std::string& name) {
  if (const char* wrong = name_problem(name))
    throw std::invalid_argument(fmt::format("\"{}\" is not a valid preset name: {}", haptics::printable(name), wrong));
  const fs::path folder = base::user_presets_folder();
  base::make_folder(folder);
  return folder / (name + ".toml");
}

}  // namespace gearshift::session
