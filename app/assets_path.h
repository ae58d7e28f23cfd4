// Where the program's own files are: gates, cars, lessons, presets, models, sounds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift {

// share/gearshift/assets beside the folder of the running program, wherever both were moved to; in a build folder that is
// a link to the source tree's. Whether it is there is not looked at. Throws std::runtime_error where there is no /proc.
std::filesystem::path assets_folder();

// assets_folder()/kind. Throws std::runtime_error in one sentence where it is not there.
std::filesystem::path shipped_folder(std::string_view kind);

// Names of the shipped files of a kind ("gates"), sorted: "paper" for assets/gates/paper.toml.
std::vector<std::string> shipped_names(std::string_view kind);

// The file that a person means: a shipped name, or else a path.
// Where it is neither, throws std::runtime_error in one sentence: with the shipped names, or that none are installed.
std::filesystem::path find_asset(std::string_view kind, const std::string& name_or_path);

}  // namespace gearshift
