// Which moments of a drive are worth a picture, and from where.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/demo/film.h"

namespace gearshift {

// With boot and hand; the slotted plate without them; the gearbox laid open beside it.
enum class Cabin { closed, open_gate, cutaway };

struct Shot {
  std::string name;     // of the file, without extension
  std::string caption;  // one sentence
  const FilmFrame* frame = nullptr;
  std::string camera;  // see camera()
  Cabin cabin = Cabin::closed;
};

// In the order of the drive: the cabin, each gear as it comes, the hand pushing through a wall, the gearbox in the middle of
// a shift, the instruments. The film outlives the shots.
std::vector<Shot> key_shots(std::span<const FilmFrame> film, const TourResult& tour);

}  // namespace gearshift
