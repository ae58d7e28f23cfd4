// Paths of the files that ship with the program: gates, cars, lessons, presets, models, sounds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift::base {

// ../share/gearshift/assets relative to the running program, so that an installation can be moved; in a build folder it
// is a link to the source tree. Does not check that the folder exists. Throws std::runtime_error if /proc is missing.
std::filesystem::path assets_folder();

// assets_folder()/kind. Throws std::runtime_error with one sentence if it does not exist.
std::filesystem::path shipped_folder(std::string_view kind);

// Names of the shipped files of a kind ("gates"), sorted: "paper" for assets/gates/paper.toml.
std::vector<std::string> shipped_names(std::string_view kind);

// Resolves what the user typed: the name of a shipped file, otherwise a path.
// If it is neither, throws std::runtime_error with one sentence that lists the shipped names or says that none are
// installed.
std::filesystem::path find_asset(std::string_view kind, const std::string& name_or_path);

}  // namespace gearshift::base
