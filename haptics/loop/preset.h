// A preset: one file with the device, hand and haptic configuration of a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::haptics {

struct Preset {
  std::string name;
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  bool operator==(const Preset&) const = default;
};

// Missing keys keep the struct's defaults. If the file is invalid, throws FileError with file, line, key, value and
// range.
Preset read_preset(const std::string& file);
Preset parse_preset(std::string_view text, const std::string& file_name);

enum class PresetComments { none, descriptions };

// The text of a preset file with every key; with comments, each line describes its key. Numbers are written losslessly.
// An angle may come back one bit off if no number of degrees gives exactly that value; an angle that was read from
// degrees always comes back exactly.
std::string preset_text(const Preset& preset, PresetComments comments = PresetComments::none);

// The parameters that have a label on the screen, as a Markdown table: key, label, allowed values, default, and effects
// of a value that is too low or too high.
std::string parameter_table(const HapticConfig& defaults);

// Replaces the file atomically: writes a temporary file, reads it back, and renames it. The folder must exist. Throws
// FileError with one sentence if the file cannot be written or holds a value that read_preset() would reject.
void write_preset(const Preset& preset, const std::filesystem::path& file);

}  // namespace gearshift::haptics
