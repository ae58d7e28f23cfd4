// This work is based on:
// freedesktop.org. XDG Base Directory Specification, version 0.8. 2021
#include "app/base/user_folders.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gearshift::base {
namespace {

namespace fs = std::filesystem;

// Returns the value of the variable if it is an absolute path, else an empty string. From the specification: "All paths
// set in these environment variables must be absolute. If an implementation encounters a relative path [...] it should
// consider the path invalid and ignore it."
fs::path absolute_variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value == '/' ? fs::path(value) : fs::path{};
}

fs::path home(const char* variable) {
  if (fs::path by_variable = absolute_variable("HOME"); !by_variable.empty()) return by_variable;
  const passwd* user = getpwuid(getuid());
  if (user != nullptr && user->pw_dir != nullptr && *user->pw_dir == '/') return user->pw_dir;
  throw std::runtime_error(std::string("cannot find a folder for your files: set ") + variable +
                           " or HOME to an absolute path (the system has no home folder for this user)");
}

fs::path base_folder(const char* variable, const char* below_home) {
  const fs::path base = absolute_variable(variable);
  return (base.empty() ? home(variable) / below_home : base) / "gearshift";
}

}  // namespace

fs::path user_config_folder() {
  return base_folder("XDG_CONFIG_HOME", ".config");
}

fs::path user_data_folder() {
  return base_folder("XDG_DATA_HOME", ".local/share");
}

fs::path user_presets_folder() {
  return user_config_folder() / "presets";
}

HistoryLocation history_location(const std::string& requested) {
  if (!requested.empty()) return {requested, ""};
  try {
    return {user_data_folder() / "history.db", ""};
  } catch (const std::runtime_error& no_home) {
    return {"", no_home.what()};
  }
}

}  // namespace gearshift::base
