// Writes a preset with every key, so that read_preset() returns it unchanged.
#pragma once

#include <filesystem>
#include <string>

#include "haptics/loop/preset.h"

namespace gearshift::haptics {

// The text of a preset file. Numbers are written losslessly. An angle may change in its last bit if no number of
// degrees gives exactly this value; an angle that was read from degrees stays exact.
std::string preset_text(const Preset& preset);

// Replaces the file atomically: writes a temporary file, reads it back, and renames it. The folder must exist. Throws
// FileError with one sentence if the file cannot be written or holds a value that read_preset() would reject.
void write_preset(const Preset& preset, const std::filesystem::path& file);

}  // namespace gearshift::haptics
