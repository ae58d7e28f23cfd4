// The drive as the cabin sees it: one frame every 1/60 s, lever, feet and car together.
#pragma once

#include <span>
#include <vector>

#include "app/stage/stage.h"
#include "app/tour/tour.h"

namespace gearshift {

struct FilmFrame {
  double time = 0.0;  // [s]
  HapticSnapshot lever;
  std::vector<HapticEvent> events;  // since the frame before
  VehicleState car;
};

// The car follows the gears of the drive and the feet of feet_at().
void drive_car(std::vector<FilmFrame>& film, std::span<const GearTime> engaged);

// The frame nearest to that time. The film is not empty.
const FilmFrame& frame_at(std::span<const FilmFrame> film, double time);

}  // namespace gearshift
