// One haptic cycle as the teacher sees it: lever, pedals, car.
#pragma once

#include "app/vehicle/vehicle_state.h"
#include "haptics/device/hand.h"
#include "haptics/loop/haptic_snapshot.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

struct DriveSample {
  HapticSnapshot lever;
  DriverControls controls;
  VehicleState car;
  double time() const noexcept { return 1e-9 * static_cast<double>(lever.time_ns); }  // [s]
};

// What a driver does in the next cycle.
struct DriverAction {
  HandTarget hand;
  DriverControls controls;
};

}  // namespace gearshift
