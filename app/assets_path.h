// Where the program's own files are: gates, cars, lessons, presets, models, sounds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift {

// The source tree's assets: there is no installed copy yet.
std::filesystem::path assets_folder();

// Names of the shipped files of a kind ("gates"), sorted: "paper" for assets/gates/paper.toml.
std::vector<std::string> shipped_names(std::string_view kind);

// The file that a person means: a shipped name, or else a path.
// Where it is neither, throws std::runtime_error in one sentence with the shipped names.
std::filesystem::path find_asset(std::string_view kind, const std::string& name_or_path);

}  // namespace gearshift
