// Finds presets by name: the shipped ones and those that the user has saved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gearshift::session {

// Names of the shipped presets, then of the user's own; only the shipped ones if there is no home folder.
std::vector<std::string> preset_names();

// name: the name of a shipped or a user's preset, or a path. Throws std::runtime_error with one sentence.
std::filesystem::path preset_file(const std::string& name);

// The file in which to save a user's preset called `name`; creates the folder. Throws std::invalid_argument with one
// sentence if a shipped preset has that name or it cannot be a file name. Throws std::runtime_error if there is no home
// folder.
std::filesystem::path user_preset_file(const std::string& name);

}  // namespace gearshift::session
