#include "app/demo/shots.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace gearshift {
namespace {

constexpr double kRpm = 60.0 / 6.283185307179586;  // per rad/s
constexpr double kInGear = 0.25;                   // [s] after a gear came: the lever rests in it
constexpr double kAsItComesIn = 0.05;              // [s] and the hand is still on the knob
constexpr double kHolds = 0.9;                     // [1] of the hand brake
constexpr double kTakesHold = 5.0;                 // [N m] of the clutch
constexpr double kDrives = 2.0;                    // [m/s]
constexpr double kStands = 0.05;                   // [m/s]

double depth_beyond_wall(const FilmFrame& frame) {
  return glm::distance(frame.lever.lever, frame.lever.proxy);
}

const FilmFrame& deepest_frame(std::span<const FilmFrame> film) {
  return *std::max_element(film.begin(), film.end(), [](const FilmFrame& a, const FilmFrame& b) {
    return depth_beyond_wall(a) < depth_beyond_wall(b);
  });
}

const FilmFrame& fastest_frame(std::span<const FilmFrame> film) {
  return *std::max_element(film.begin(), film.end(),
                           [](const FilmFrame& a, const FilmFrame& b) { return a.car.road_speed < b.car.road_speed; });
}

std::string speeds(const FilmFrame& frame) {
  return fmt::format("{:.0f} km/h, {:.0f} rpm in {}", kKmhPerMps * frame.car.road_speed, kRpm * frame.car.engine_speed,
                     gear_name(frame.car.gear));
}

// The clutch carries most while the hand brake holds; null where it never does.
const FilmFrame* bite_frame(std::span<const FilmFrame> film) {
  const FilmFrame* best = nullptr;
  for (const FilmFrame& frame : film) {
    const bool held = frame.car.hand_brake > kHolds && std::abs(frame.car.road_speed) < kStands;
    if (!held || frame.car.clutch_torque < kTakesHold) continue;
    if (!best || frame.car.clutch_torque > best->car.clutch_torque) best = &frame;
  }
  return best;
}

// On the road, the ring rubs and its dogs are furthest apart; null where it never does.
const FilmFrame* ring_frame(std::span<const FilmFrame> film) {
  const FilmFrame* best = nullptr;
  for (const FilmFrame& frame : film) {
    if (frame.car.sync != SyncPhase::synchronising || frame.car.road_speed < kDrives) continue;
    if (!best || std::abs(frame.car.dog_difference) > std::abs(best->car.dog_difference)) best = &frame;
  }
  return best;
}

// The last moment before that gear: the sleeve is between its dogs.
const FilmFrame& before(std::span<const FilmFrame> film, const GearTime& gear) {
  const FilmFrame& in = frame_at(film, gear.time);
  return &in == film.data() ? in : *(&in - 1);
}

}  // namespace

std::vector<Shot> tour_shots(std::span<const FilmFrame> film) {
  const std::vector<GearTime> came = gears_of(film);
  std::vector<GearTime> gears;  // the first time that each came
  for (const GearTime& gear : came) {
    const auto same = [&](const GearTime& known) { return known.gear == gear.gear; };
    if (std::none_of(gears.begin(), gears.end(), same)) gears.push_back(gear);
  }
  std::vector<Shot> shots;
  shots.push_back({"cabin", "The cabin before the first gear", &film.front(), "driver"});
  for (const GearTime& gear : gears) {
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
  if (gears.size() > 1) {
    shots.push_back(
        {"gearbox",
         fmt::format("The gearbox laid open, between {} and {}", gear_name(gears[0].gear), gear_name(gears[1].gear)),
         &before(film, gears[1]), "gearbox"});
    shots.push_back({"gearbox_in", fmt::format("The same in {}", gear_name(gears[1].gear)),
                     &frame_at(film, gears[1].time + kInGear), "gearbox"});
  }
  if (gears.empty()) return shots;
  const GearTime& middle = gears[gears.size() / 2];
  shots.push_back({"hand", fmt::format("The hand in {}", gear_name(middle.gear)),
                   &frame_at(film, middle.time + kAsItComesIn), "lever"});
  shots.push_back({"cluster", speeds(fastest_frame(film)), &fastest_frame(film), "cluster"});
  shots.push_back({"driver", fmt::format("{} from the driver's eye", gear_name(gears.back().gear)),
                   &frame_at(film, gears.back().time + kInGear), "driver"});
  return shots;
}

std::vector<Shot> lesson_shots(std::span<const FilmFrame> film, const std::string& lesson) {
  std::vector<Shot> shots;
  if (const FilmFrame* bite = bite_frame(film)) {
    shots.push_back({lesson + "_bite",
                     fmt::format("The bite point: the clutch carries {:.0f} N m, the engine turns at {:.0f} rpm, and "
                                 "the hand brake still holds the car",
                                 bite->car.clutch_torque, kRpm * bite->car.engine_speed),
                     bite, "driver"});
  }
  if (const FilmFrame* ring = ring_frame(film)) {
    shots.push_back(
        {lesson + "_ring",
         fmt::format("The synchroniser blocks: its dogs are {:.0f} rpm apart, the hand pushes with {:.0f} N",
                     kRpm * std::abs(ring->car.dog_difference), glm::length(ring->lever.f_h)),
         ring, "gearbox"});
    const std::vector<GearTime> gears = gears_of(film);
    const auto next =
        std::find_if(gears.begin(), gears.end(), [&](const GearTime& gear) { return gear.time > ring->time; });
    if (next != gears.end()) {
      shots.push_back({lesson + "_in",
                       fmt::format("{} is in, {:.2f} s later", gear_name(next->gear), next->time - ring->time),
                       &frame_at(film, next->time + kAsItComesIn), "gearbox"});
    }
  }
  const FilmFrame& fast = fastest_frame(film);
  shots.push_back({lesson + "_away", speeds(fast), &fast, "driver"});
  return shots;
}

}  // namespace gearshift
