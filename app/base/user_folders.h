// Locations of the user's files: the XDG base directories, or their defaults below the home folder.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::base {

// $XDG_CONFIG_HOME/gearshift or ~/.config/gearshift; $XDG_DATA_HOME/gearshift or ~/.local/share/gearshift. They create
// nothing, and throw std::runtime_error with one sentence if neither HOME nor the system names a home folder.
std::filesystem::path user_config_folder();
std::filesystem::path user_data_folder();

std::filesystem::path user_presets_folder();  // in the config folder

struct HistoryLocation {
  std::filesystem::path file;  // empty if no location was found
  std::string problem;         // reason for an empty `file`, one sentence
};

// The location of the learner's history: the requested file, or if it is empty, history.db in the user's data folder.
HistoryLocation history_location(const std::string& requested);

}  // namespace gearshift::base
