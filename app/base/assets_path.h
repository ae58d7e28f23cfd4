// Paths of the files that ship with the program: gates, cars, lessons, presets, models, sounds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift::base {

// The folder ../share/gearshift/assets, relative to the folder of the running program. So an installation can be moved.
// In a build folder, it is a link to the source tree. Does not check that the folder exists. Throws std::runtime_error
// if /proc is missing.
std::filesystem::path assets_folder();

// The folder assets_folder()/kind. Throws std::runtime_error with a one-sentence message if the folder does not exist.
std::filesystem::path shipped_folder(std::string_view kind);

// Sorted names of the shipped files of a kind, for example "paper" for assets/gates/paper.toml if kind is "gates".
std::vector<std::string> shipped_names(std::string_view kind);

// Finds the file that the user named: a shipped file of this kind, or else a file at this path. If the text is neither
// a shipped name nor a path, throws std::runtime_error with a message that lists the shipped names or says that none
// are installed.
std::filesystem::path find_asset(std::string_view kind, const std::string& name_or_path);

}  // namespace gearshift::base
