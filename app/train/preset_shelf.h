// Presets by name: the shipped ones, and those that the user has saved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gearshift {

// The shipped ones, then the user's own, each once. Of a user without a home folder: the shipped ones.
std::vector<std::string> preset_names();

// A shipped name, one of the user's own, or else a path. Throws std::runtime_error with one sentence.
std::filesystem::path preset_file(const std::string& name);

// Where the user's own of that name is saved; makes the folder. Throws std::invalid_argument with one sentence for a
// shipped name and for one that is no file's, std::runtime_error where there is no folder.
std::filesystem::path own_preset_file(const std::string& name);

}  // namespace gearshift
