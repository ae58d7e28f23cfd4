// Where the user's own files live: the XDG base directories, or their defaults below the home folder.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift {

// $XDG_CONFIG_HOME/gearshift, or ~/.config/gearshift; $XDG_DATA_HOME/gearshift, or ~/.local/share/gearshift. Nothing is
// made. Throw std::runtime_error with one sentence where no home folder is known, neither by HOME nor by the system.
std::filesystem::path user_config_folder();
std::filesystem::path user_data_folder();

std::filesystem::path user_presets_folder();  // in the config folder

struct HistoryPlace {
  std::filesystem::path file;  // empty: there is none
  std::string problem;         // then one sentence why
};

// The given file, or where that is empty the user's own: history.db in the data folder.
HistoryPlace history_place(const std::string& given);

}  // namespace gearshift
