// Locations of the user's files: the XDG base directories, or their defaults below the home folder.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::base {

// $XDG_CONFIG_HOME/gearshift or ~/.config/gearshift; $XDG_DATA_HOME/gearshift or ~/.local/share/gearshift. Creates
// nothing. Throws std::runtime_error with one sentence if neither HOME nor the system gives a home folder.
std::filesystem::path user_config_folder();
std::filesystem::path user_data_folder();

std::filesystem::path user_presets_folder();  // in the config folder

struct HistoryLocation {
  std::filesystem::path file;  // empty: no location found
  std::string problem;         // one sentence why, if there is none
};

// The requested file; if empty, the user's own: history.db in the data folder.
HistoryLocation history_location(const std::string& requested);

}  // namespace gearshift::base
