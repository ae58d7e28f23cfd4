// Finds presets by name: the shipped ones and those that the user has saved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gearshift::session {

// Shipped presets, then the user's own, each once. Only the shipped ones if there is no home folder.
std::vector<std::string> preset_names();

// name: of a shipped or a user's preset, or a path. Throws std::runtime_error with one sentence.
std::filesystem::path preset_file(const std::string& name);

// Where to save a user's preset of that name; creates the folder. Throws std::invalid_argument with one sentence if a
// shipped preset has that name or it cannot be a file name, std::runtime_error if there is no user folder.
std::filesystem::path user_preset_file(const std::string& name);

}  // namespace gearshift::session
