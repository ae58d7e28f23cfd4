// A preset: one file with the device, hand and haptic configuration of a run.
#pragma once

#include <string>

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::haptics {

struct Preset {
  std::string name;
  HapticConfig haptics;
  SimulatedLeverConfig lever;
};

// Missing keys keep the struct's defaults. If the file is invalid, throws FileError with file, line, key, value and
// range.
Preset read_preset(const std::string& file);

}  // namespace gearshift::haptics
