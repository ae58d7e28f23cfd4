// Selects the moments of a drive to picture, and the camera for each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/demo/film.h"

namespace gearshift::demo {

struct Shot {
  std::string name;     // of the file, without extension
  std::string caption;  // one sentence
  const FilmFrame* frame = nullptr;
  std::string camera;  // see camera(); cabin_for_camera() tells how far the cabin is cut open for it
};

// Both functions return shots in the order of the drive. The film must not be empty and must outlive the shots.
//
// Shots of a drive through every gear: the cabin, each gear as it engages, the hand pushing into a wall, the gearbox in
// the middle of a shift, the instruments.
std::vector<Shot> tour_shots(std::span<const FilmFrame> film);
// Shots of a lesson: the bite point while a brake still holds the car, a blocking synchroniser ring and the engaged
// dogs, the end. Moments that the drive does not have are left out. `lesson`: prefix of the picture names.
std::vector<Shot> lesson_shots(std::span<const FilmFrame> film, const std::string& lesson);

}  // namespace gearshift::demo
