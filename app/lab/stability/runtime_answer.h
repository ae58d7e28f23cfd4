// The wall that the trainer would use instead of the wanted one, as decided by the check that protects its loop.
#pragma once

#include <string>

#include "app/lab/stability/stability.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct RuntimeAnswer {
  std::string problem;               // why the trainer rejects these values; empty if it accepts them
  double stiffness = 0.0;            // [N/m] the wanted stiffness, clipped to a tuning's valid range
  double damping = 0.0;              // [N s/m] the wanted damping, clipped to a tuning's valid range
  haptics::AdmittedTuning admitted;  // for a device with this handle on both axes, and every listed hand
};

RuntimeAnswer query_runtime(const StabilityQuestion& question);

}  // namespace gearshift::lab
