// One haptic cycle as lesson assessment sees it: lever, pedals and car.
#pragma once

#include "app/vehicle/vehicle_state.h"
#include "haptics/device/hand.h"
#include "haptics/loop/haptic_snapshot.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

struct DriveSample {
  haptics::HapticSnapshot lever;
  haptics::DriverControls controls;
  VehicleState car;
  double time() const noexcept { return 1e-9 * static_cast<double>(lever.time_ns); }  // [s]
};

inline constexpr double kMaxSampleInterval = 0.1;  // [s] a longer interval counts as a gap in the recording

// True while the sleeve touches the synchroniser ring or the dogs, until the gear is in.
inline bool touches_dogs(const DriveSample& sample) noexcept {
  return sample.car.sync != SyncPhase::free && sample.car.sync != SyncPhase::meshed;
}

// A driver's action for the next cycle.
struct DriverAction {
  haptics::HandTarget hand;
  haptics::DriverControls controls;
};

}  // namespace gearshift::vehicle
