// A drive as the cabin sees it: one frame every 1/60 s, lever and car together.
#pragma once

#include <span>
#include <vector>

#include "app/tour/tour.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

struct FilmFrame {
  double time = 0.0;  // [s]
  HapticSnapshot lever;
  std::vector<HapticEvent> events;  // since the frame before
  VehicleState car;
};

// Each change of the gear that the lever is in, neutral left out.
std::vector<GearTime> gears_of(std::span<const FilmFrame> film);

// The frame nearest to that time. The film is not empty.
const FilmFrame& frame_at(std::span<const FilmFrame> film, double time);

}  // namespace gearshift
