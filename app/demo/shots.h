// Which moments of a drive are worth a picture, and from where.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/demo/film.h"

namespace gearshift {

struct Shot {
  std::string name;     // of the file, without extension
  std::string caption;  // one sentence
  const FilmFrame* frame = nullptr;
  std::string camera;  // see camera(); how far the cabin is laid open: cabin_seen_from()
};

// In the order of the drive. The film is not empty and outlives the shots.
//
// Of a drive through every gear: the cabin, each gear as it comes, the hand pushing through a wall, the gearbox in the
// middle of a shift, the instruments.
std::vector<Shot> tour_shots(std::span<const FilmFrame> film);
// Of a lesson: where the clutch takes hold while a brake still holds the car, the ring that blocks and the dogs that are
// in, the end. What the drive has not is left out. `lesson` begins the pictures' names.
std::vector<Shot> lesson_shots(std::span<const FilmFrame> film, const std::string& lesson);

}  // namespace gearshift
