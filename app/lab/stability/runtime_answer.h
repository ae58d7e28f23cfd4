// The wall that the trainer would use instead of the wanted one, as decided by the check that protects its loop.
#pragma once

#include <string>

#include "app/lab/stability/stability.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct RuntimeAnswer {
  std::string problem;               // why the trainer does not run with these values; empty if it does
  double stiffness = 0.0;            // [N/m] requested: the wanted stiffness, clipped to what a tuning may have
  double damping = 0.0;              // [N s/m] requested, clipped likewise
  haptics::AdmittedTuning admitted;  // on a device with this handle on both axes, for every listed hand
};

RuntimeAnswer query_runtime(const StabilityQuestion& question);

}  // namespace gearshift::lab
