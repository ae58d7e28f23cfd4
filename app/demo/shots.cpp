#include "app/demo/shots.h"

#include <algorithm>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace gearshift {
namespace {

constexpr double kInGear = 0.25;  // [s] after a gear came: the lever rests in it

double depth_beyond_wall(const FilmFrame& frame) {
  return glm::distance(frame.lever.lever, frame.lever.proxy);
}

const FilmFrame& deepest_frame(std::span<const FilmFrame> film) {
  return *std::max_element(film.begin(), film.end(), [](const FilmFrame& a, const FilmFrame& b) {
    return depth_beyond_wall(a) < depth_beyond_wall(b);
  });
}

// Halfway between two gears: the sleeve is between its dogs.
const FilmFrame& between(std::span<const FilmFrame> film, const GearTime& from, const GearTime& to) {
  return frame_at(film, 0.5 * (from.time + to.time));
}

}  // namespace

std::vector<Shot> key_shots(std::span<const FilmFrame> film, const TourResult& tour) {
  std::vector<Shot> shots;
  shots.push_back({"cabin", "The cabin before the first gear", &film.front(), "driver"});
  for (const GearTime& gear : tour.engaged) {
    const std::string name = gear_name(gear.gear);
    shots.push_back({fmt::format("gear_{}", name), fmt::format("{} is in, {:.2f} s", name, gear.time),
                     &frame_at(film, gear.time + kInGear), "gate"});
  }
  const FilmFrame& deepest = deepest_frame(film);
  shots.push_back(
      {"clamp",
       fmt::format("The hand is {:.2f} mm beyond the wall and is held with {:.1f} N: the lever that is drawn "
                   "stays in the gate",
                   1e3 * depth_beyond_wall(deepest), glm::length(deepest.lever.commanded)),
       &deepest, "gate"});
  if (tour.engaged.size() > 1) {
    shots.push_back({"gearbox",
                     fmt::format("The gearbox laid open, between {} and {}", gear_name(tour.engaged[0].gear),
                                 gear_name(tour.engaged[1].gear)),
                     &between(film, tour.engaged[0], tour.engaged[1]), "gearbox"});
    shots.push_back({"gearbox_in", fmt::format("The same in {}", gear_name(tour.engaged[1].gear)),
                     &frame_at(film, tour.engaged[1].time + kInGear), "gearbox"});
  }
  if (!tour.engaged.empty()) {
    const GearTime& middle = tour.engaged[tour.engaged.size() / 2];
    shots.push_back({"hand", fmt::format("The hand in {}", gear_name(middle.gear)),
                     &frame_at(film, middle.time + kInGear), "lever"});
    const GearTime& last = tour.engaged.back();
    const FilmFrame& fast = *std::max_element(film.begin(), film.end(), [](const FilmFrame& a, const FilmFrame& b) {
      return a.car.road_speed < b.car.road_speed;
    });
    shots.push_back({"cluster",
                     fmt::format("{:.0f} km/h, {:.0f} rpm", kKmhPerMps * fast.car.road_speed,
                                 fast.car.engine_speed * 30.0 / 3.14159265358979),
                     &fast, "cluster"});
    shots.push_back({"driver", fmt::format("{} from the driver's eye", gear_name(last.gear)),
                     &frame_at(film, last.time + kInGear), "driver"});
  }
  return shots;
}

}  // namespace gearshift
