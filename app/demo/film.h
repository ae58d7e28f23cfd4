// A recorded drive for rendering: the state of lever and car every 1/60 s.
#pragma once

#include <span>
#include <vector>

#include "app/lab/tour/tour.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::demo {

struct FilmFrame {
  double time = 0.0;  // [s]
  haptics::HapticSnapshot lever;
  std::vector<haptics::HapticEvent> events;  // since the previous frame
  vehicle::VehicleState car;
};

// Every gear that the lever enters, without neutral.
std::vector<lab::GearTime> gears_of(std::span<const FilmFrame> film);

// The frame nearest to that time. The film must not be empty.
const FilmFrame& frame_at(std::span<const FilmFrame> film, double time);

}  // namespace gearshift::demo
