// A film: a recorded drive from which pictures can be rendered, with the state of lever and car every 1/60 s.
#pragma once

#include <span>
#include <vector>

#include "app/lab/tour/tour.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::demo {

struct FilmFrame {
  double time = 0.0;  // [s] since the start of the drive
  haptics::HapticSnapshot lever;
  std::vector<haptics::HapticEvent> events;  // events since the previous frame
  vehicle::VehicleState car;
};

// Returns every gear that the lever enters, in order, without neutral.
std::vector<lab::GearTime> gears_of(std::span<const FilmFrame> film);

// Returns the frame nearest to this time [s]. The film must not be empty.
const FilmFrame& frame_at(std::span<const FilmFrame> film, double time);

}  // namespace gearshift::demo
