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

inline constexpr double kLongestSample = 0.1;  // [s] between samples; longer is a gap in the record

// Ring or dogs are against each other, and not in.
inline bool touches_dogs(const DriveSample& sample) noexcept {
  return sample.car.sync != SyncPhase::free && sample.car.sync != SyncPhase::meshed;
}

// What a driver does in the next cycle.
struct DriverAction {
  HandTarget hand;
  DriverControls controls;
};

}  // namespace gearshift
