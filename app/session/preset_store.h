// Finds presets by name: the shipped ones and those that the user has saved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gearshift::session {

// Names of the shipped presets, followed by the user's own. If there is no home folder, only shipped presets are
// listed.
std::vector<std::string> preset_names();

// Returns the file of a preset. `name`: name of a shipped preset or of one that the user has saved, or a path. Throws
// std::runtime_error with a one-sentence message.
std::filesystem::path preset_file(const std::string& name);

// Returns the file in which to save a user's preset called `name`; creates the folder. Throws std::invalid_argument
// with a one-sentence message if a shipped preset has this name or the name cannot be a file name. Throws
// std::runtime_error if there is no home folder.
std::filesystem::path user_preset_file(const std::string& name);

}  // namespace gearshift::session
