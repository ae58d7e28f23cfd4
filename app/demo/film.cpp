#include "app/demo/film.h"

#include <algorithm>
#include <cmath>

namespace gearshift::demo {

std::vector<lab::GearTime> gears_of(std::span<const FilmFrame> film) {
  std::vector<lab::GearTime> gears;
  int gear = haptics::kNeutralGear;
  for (const FilmFrame& frame : film) {
    if (frame.lever.gear != gear && frame.lever.gear != haptics::kNeutralGear)
      gears.push_back({frame.lever.gear, frame.time});
    gear = frame.lever.gear;
  }
  return gears;
}

const FilmFrame& frame_at(std::span<const FilmFrame> film, double time) {
  return *std::min_element(film.begin(), film.end(), [time](const FilmFrame& a, const FilmFrame& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

}  // namespace gearshift::demo
