// Writes a preset so that read_preset() gives it back, every key.
#pragma once

#include <filesystem>
#include <string>

#include "haptics/loop/preset.h"

namespace gearshift {

// The file's text. Numbers have all their digits; an angle in degrees may come back a last bit off where no number of
// degrees gives it (one that was read from degrees never does).
std::string preset_text(const Preset& preset);

// Whole or not at all: written beside, read back, then renamed over a file of that name. The folder must exist.
// Throws FileError in one sentence: it cannot be written, or holds a value that read_preset() would refuse.
void write_preset(const Preset& preset, const std::filesystem::path& file);

}  // namespace gearshift
