#include "app/train/preset_shelf.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/output_folder.h"
#include "app/trainer/user_folder.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

bool is_shipped(const std::string& name) {
  const std::vector<std::string> shipped = shipped_names("presets");
  return std::find(shipped.begin(), shipped.end(), name) != shipped.end();
}

// Empty where no home folder is known.
fs::path own_folder() {
  try {
    return user_presets_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

const char* wrong_with(const std::string& name) {
  if (name.empty()) return "it is empty";
  if (name.front() == '.') return "it begins with a dot";
  if (name.find('/') != std::string::npos) return "it has a slash";
  return is_shipped(name) ? "a shipped preset is called that" : nullptr;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names = shipped_names("presets"), own;
  std::error_code error;
  for (fs::directory_iterator entry(own_folder(), error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().stem().string();
    if (entry->path().extension() == ".toml" && wrong_with(name) == nullptr) own.push_back(name);
  }
  std::sort(own.begin(), own.end());
  names.insert(names.end(), own.begin(), own.end());
  return names;
}

fs::path preset_file(const std::string& name) {
  std::error_code error;
  const fs::path folder = own_folder(), own = folder / (name + ".toml");
  const bool is_own = !folder.empty() && wrong_with(name) == nullptr && fs::exists(own, error);
  return is_own ? own : find_asset("presets", name);
}

fs::path own_preset_file(const std::string& name) {
  if (const char* wrong = wrong_with(name))
    throw std::invalid_argument(fmt::format("\"{}\" cannot be a preset's name: {}", printable(name), wrong));
  const fs::path folder = user_presets_folder();
  make_folder(folder);
  return folder / (name + ".toml");
}

}  // namespace gearshift
