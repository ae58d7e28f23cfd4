// Selects the moments of a drive that the demo shows as pictures, and the camera for each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/demo/film.h"

namespace gearshift::demo {

struct Shot {
  std::string name;     // file name of the picture without extension
  std::string caption;  // one sentence
  const FilmFrame* frame = nullptr;
  std::string camera;  // see camera(); also defines the kind of cabin, see cabin_for_camera()
};

// In the two functions below, the film must not be empty and must outlive the shots.

// Shots of a drive through every gear of the gate: the cabin, each gear as it engages, the hand pushing into a wall, the
// gearbox, if it has one, between two gears and in gear, the hand, the instruments.
std::vector<Shot> tour_shots(std::span<const FilmFrame> film, const haptics::Gate& gate);
// Shots of a lesson: the bite point while the handbrake still holds the car, a blocking synchroniser ring and then the
// engaged dogs, the highest speed. Moments that do not occur in the drive are left out. `lesson`: prefix for the names
// of the shots.
std::vector<Shot> lesson_shots(std::span<const FilmFrame> film, const std::string& lesson);

}  // namespace gearshift::demo
