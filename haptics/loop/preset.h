// A preset: one file that says which device, hand and configuration a run has.
#pragma once

#include <string>

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift {

struct Preset {
  std::string name;
  HapticConfig haptics;
  SimulatedLeverConfig lever;
};

// Keys that a file leaves out keep the default of their struct. Throws FileError: file, line, key, value, range.
Preset read_preset(const std::string& file);

}  // namespace gearshift
