// Makes all sections of the reproduction, in the order of the paper.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

std::span<const NamedSection> all_sections();

// Prepares the reproduction for a preset on the paper's gate. Creates no file and no folder. Throws FileError or
// std::invalid_argument if the preset, the gate or the configuration is invalid.
Study make_study(const haptics::Preset& preset, const haptics::GateLayout& layout, const std::filesystem::path& folder);

// Called often. `what`: the current section. `fraction`: completed part of all work (0 to 1).
using ReproduceProgress = std::function<void(std::string_view what, double fraction)>;

// Makes the sections whose ids are in `only`, in the order of the paper. If `only` is empty, makes all sections. The
// study's folder must exist. If a section fails, it contains the reason, and the other sections are still made.
std::vector<Section> make_sections(Study study, const std::vector<std::string>& only,
                                   const ReproduceProgress& progress);

}  // namespace gearshift::lab
