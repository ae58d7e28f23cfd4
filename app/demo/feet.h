// What the feet do while the hand shifts: clutch down before the lever leaves a gear, up after the next is in.
#pragma once

#include <span>

#include "app/tour/tour.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

// time [s] of the drive; engaged: the gears of the whole drive, as they came.
DriverControls feet_at(double time, std::span<const GearTime> engaged);

}  // namespace gearshift
