// The wall that the trainer would use in place of the wanted wall: the trainer's own stability check may limit or
// reject the wanted values.
#pragma once

#include <string>

#include "app/lab/stability/stability.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct RuntimeAnswer {
  std::string problem;               // why the trainer rejects the wanted values; empty if it accepts them
  double stiffness = 0.0;            // [N/m] the wanted stiffness, clipped to the trainer's valid range
  double damping = 0.0;              // [N s/m] the wanted damping, clipped to the trainer's valid range
  haptics::AdmittedTuning admitted;  // for every named hand, and a device with the question's handle on both axes
};

RuntimeAnswer query_runtime(const StabilityQuestion& question);

}  // namespace gearshift::lab
