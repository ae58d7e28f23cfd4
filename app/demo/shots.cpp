#include "app/demo/shots.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "haptics/files/parameter.h"

namespace gearshift::demo {
namespace {

constexpr double kRestDelay = 0.25;        // [s] delay after a gear engages: the lever is at rest
constexpr double kHandDelay = 0.05;        // [s] delay after a gear engages: the hand still holds the knob
constexpr double kMinHandBrake = 0.9;      // [1] the handbrake holds the car if pulled further than this
constexpr double kMinClutchTorque = 5.0;   // [N m] the clutch bites if it transmits more than this
constexpr double kMinDrivingSpeed = 2.0;   // [m/s] the car is driving if it is faster than this
constexpr double kStandstillSpeed = 0.05;  // [m/s] the car is at rest if it is slower than this

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
  return fmt::format("{:.0f} {}, {:.0f} rpm in gear {}", vehicle::in_unit(frame.car.speed_unit, frame.car.road_speed),
                     to_string(frame.car.speed_unit), frame.car.engine_speed / haptics::kTurnPerMinute,
                     haptics::gear_name(frame.car.gear));
}

// Returns the frame with the largest clutch torque while the handbrake holds the car; null if there is no such frame.
const FilmFrame* bite_frame(std::span<const FilmFrame> film) {
  const FilmFrame* best = nullptr;
  for (const FilmFrame& frame : film) {
    const bool held = frame.car.pedals.hand_brake > kMinHandBrake && std::abs(frame.car.road_speed) < kStandstillSpeed;
    if (!held || frame.car.clutch_torque < kMinClutchTorque) continue;
    if (!best || frame.car.clutch_torque > best->car.clutch_torque) best = &frame;
  }
  return best;
}

// Returns the frame of the moving car in which the synchroniser ring rubs with the largest speed difference; null if
// there is no such frame.
const FilmFrame* ring_frame(std::span<const FilmFrame> film) {
  const FilmFrame* best = nullptr;
  for (const FilmFrame& frame : film) {
    if (frame.car.sync != vehicle::SyncPhase::synchronising || frame.car.road_speed < kMinDrivingSpeed) continue;
    if (!best || std::abs(frame.car.dog_difference) > std::abs(best->car.dog_difference)) best = &frame;
  }
  return best;
}

// Returns the last frame before the gear engages, when the sleeve is about to slide over the gear's dogs.
const FilmFrame& before(std::span<const FilmFrame> film, const lab::GearTime& gear) {
  const FilmFrame& in = frame_at(film, gear.time);
  return &in == film.data() ? in : *(&in - 1);
}

// A file's name for the gear's picture: with its label if that is of letters and digits.
std::string picture_name(const haptics::Gate& gate, int gear) {
  const std::string label = haptics::gear_label(gate, gear);
  const bool is_plain =
      std::all_of(label.begin(), label.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
  return is_plain ? "gear_" + label : fmt::format("place_{}", haptics::slot_of_gear(gate, gear) + 1);
}

}  // namespace

std::vector<Shot> tour_shots(std::span<const FilmFrame> film, const haptics::Gate& gate) {
  const std::vector<lab::GearTime> came = gears_of(film);
  std::vector<lab::GearTime> gears;  // only the first engagement of each gear
  for (const lab::GearTime& gear : came) {
    const auto same = [&](const lab::GearTime& known) { return known.gear == gear.gear; };
    if (std::none_of(gears.begin(), gears.end(), same)) gears.push_back(gear);
  }
  std::vector<Shot> shots;
  shots.push_back({"cabin", "The cabin before the first shift", &film.front(), "driver"});
  for (const lab::GearTime& gear : gears) {
    const std::string name = haptics::gear_label(gate, gear.gear);
    shots.push_back({picture_name(gate, gear.gear), fmt::format("Gear {} engaged after {:.2f} s", name, gear.time),
                     &frame_at(film, gear.time + kRestDelay), "gate"});
  }
  const FilmFrame& deepest = deepest_frame(film);
  shots.push_back(
      {"clamp",
       fmt::format("The hand is {:.2f} mm beyond the wall and is pushed back with {:.1f} N; the drawn lever "
                   "stays in the gate",
                   1e3 * depth_beyond_wall(deepest), glm::length(deepest.lever.commanded)),
       &deepest, "gate"});
  if (gears.size() > 1 && !haptics::is_mechanism(gate)) {
    shots.push_back({"gearbox",
                     fmt::format("Cutaway view of the gearbox between gears {} and {}",
                                 haptics::gear_label(gate, gears[0].gear), haptics::gear_label(gate, gears[1].gear)),
                     &before(film, gears[1]), "gearbox"});
    shots.push_back({"gearbox_in", fmt::format("The gearbox in gear {}", haptics::gear_label(gate, gears[1].gear)),
                     &frame_at(film, gears[1].time + kRestDelay), "gearbox"});
  }
  if (gears.empty()) return shots;
  const lab::GearTime& middle = gears[gears.size() / 2];
  shots.push_back({"hand", fmt::format("The hand on the lever, in gear {}", haptics::gear_label(gate, middle.gear)),
                   &frame_at(film, middle.time + kHandDelay), "lever"});
  shots.push_back({"cluster", speeds(fastest_frame(film)), &fastest_frame(film), "cluster"});
  shots.push_back({"driver",
                   fmt::format("Gear {}, seen from the driver's seat", haptics::gear_label(gate, gears.back().gear)),
                   &frame_at(film, gears.back().time + kRestDelay), "driver"});
  return shots;
}

std::vector<Shot> lesson_shots(std::span<const FilmFrame> film, const std::string& lesson) {
  std::vector<Shot> shots;
  if (const FilmFrame* bite = bite_frame(film)) {
    shots.push_back({lesson + "_bite",
                     fmt::format("The bite point: the clutch carries {:.0f} N m, the engine turns at {:.0f} rpm, and "
                                 "the handbrake still holds the car",
                                 bite->car.clutch_torque, bite->car.engine_speed / haptics::kTurnPerMinute),
                     bite, "driver"});
  }
  if (const FilmFrame* ring = ring_frame(film)) {
    shots.push_back(
        {lesson + "_ring",
         fmt::format("The synchroniser blocks the shift: its two sides differ by {:.0f} rpm while the hand "
                     "pushes with {:.0f} N",
                     std::abs(ring->car.dog_difference) / haptics::kTurnPerMinute, glm::length(ring->lever.f_h)),
         ring, "gearbox"});
    const std::vector<lab::GearTime> gears = gears_of(film);
    const auto next =
        std::find_if(gears.begin(), gears.end(), [&](const lab::GearTime& gear) { return gear.time > ring->time; });
    if (next != gears.end()) {
      shots.push_back(
          {lesson + "_in",
           fmt::format("Gear {} engaged {:.2f} s later", haptics::gear_name(next->gear), next->time - ring->time),
           &frame_at(film, next->time + kHandDelay), "gearbox"});
    }
  }
  const FilmFrame& fast = fastest_frame(film);
  shots.push_back({lesson + "_away", speeds(fast), &fast, "driver"});
  return shots;
}

}  // namespace gearshift::demo
