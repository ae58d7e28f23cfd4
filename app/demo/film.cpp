#include "app/demo/film.h"

#include <algorithm>
#include <cmath>

#include "app/train/feet.h"
#include "app/vehicle/rolling_car.h"

namespace gearshift {

namespace {
constexpr double kStartSpeed = 30.0 / kKmhPerMps;  // [m/s] a tour is too quick to move off in
}

void drive_car(std::vector<FilmFrame>& film, std::span<const GearTime> engaged) {
  RollingCarConfig config;
  config.start_speed = kStartSpeed;
  RollingCar car(config);
  for (FilmFrame& frame : film) {
    car.step(feet_at(frame.time, engaged, car.state()), frame.lever.gear, kWatchPeriod);
    frame.car = car.state();
  }
}

const FilmFrame& frame_at(std::span<const FilmFrame> film, double time) {
  return *std::min_element(film.begin(), film.end(), [time](const FilmFrame& a, const FilmFrame& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

}  // namespace gearshift
