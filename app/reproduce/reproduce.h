// The whole reproduction: the sections in the order of the paper.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/reproduce/section.h"

namespace gearshift {

std::span<const NamedSection> all_sections();

// The study of a preset on the paper's gate. Makes no file and no folder. Throws FileError or std::invalid_argument for
// whatever the preset, the gate or the configuration cannot be.
Study make_study(const Preset& preset, const GateLayout& layout, const std::filesystem::path& folder);

// Told, often, what is in hand and which share of all is done (0 to 1).
using ReproduceProgress = std::function<void(std::string_view what, double share)>;

// Makes the sections of these ids, in the order of the paper; all where none is given. The folder exists. A section
// that cannot be made says why, and the others are made.
std::vector<Section> make_sections(Study study, const std::vector<std::string>& only,
                                   const ReproduceProgress& progress);

}  // namespace gearshift
