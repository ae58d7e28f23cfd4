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

// In the order of the drive: the cabin, each gear as it comes, the hand pushing through a wall, the gearbox in the middle of
// a shift, the instruments. The film outlives the shots.
std::vector<Shot> key_shots(std::span<const FilmFrame> film, const TourResult& tour);

}  // namespace gearshift
