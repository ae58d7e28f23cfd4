// Locations of the user's files: the XDG base directories, or their defaults below the home folder.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::base {

// The folders $XDG_CONFIG_HOME/gearshift and $XDG_DATA_HOME/gearshift. If the variable is not set: ~/.config/gearshift
// and ~/.local/share/gearshift. These functions create no folders. They throw std::runtime_error with a one-sentence
// message if neither HOME nor the system names a home folder.
std::filesystem::path user_config_folder();
std::filesystem::path user_data_folder();

std::filesystem::path user_presets_folder();  // subfolder of the config folder

struct HistoryLocation {
  std::filesystem::path file;  // empty if no location was found
  std::string problem;         // one sentence that says why `file` is empty
};

// Returns the file of the learner's history: `requested`, or history.db in the user's data folder if `requested` is
// empty.
HistoryLocation history_location(const std::string& requested);

}  // namespace gearshift::base
