// What the trainer itself would use of the wall that is asked about: the answer of the function that guards its loop.
#pragma once

#include <string>

#include "app/stability/stability.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift {

struct TrainerAnswer {
  std::string problem;      // why the trainer does not run there; empty where it does
  double stiffness = 0.0;   // [N/m] that it was asked for: the wanted one, as far as it takes it
  double damping = 0.0;     // [N s/m] the same
  AdmittedTuning admitted;  // on a device of which both axes are the handle in question, in every hand
};

TrainerAnswer ask_trainer(const StabilityQuestion& question);

}  // namespace gearshift
