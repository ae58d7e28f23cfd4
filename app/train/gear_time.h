// When a gear came.
#pragma once

#include "haptics/gate/gate.h"

namespace gearshift {

struct GearTime {
  int gear = kNeutralGear;
  double time = 0.0;  // [s]
};

}  // namespace gearshift
