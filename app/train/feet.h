// What the feet do while the hand shifts: clutch down before the lever leaves a gear, up after the next is in, slower
// where the engine labours; brake in the gear before reverse.
#pragma once

#include <span>

#include "app/train/gear_time.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

// time [s] of the drive; engaged: the gears of the whole drive, as they came; car: as it is then.
DriverControls feet_at(double time, std::span<const GearTime> engaged, const VehicleState& car);

}  // namespace gearshift
