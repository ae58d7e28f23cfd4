// The road under the car and what passes by. The car stands still at the world's origin; the road moves back.
#pragma once

#include <cstdint>

namespace gearshift {

inline constexpr double kTileLength = 12.0;    // [m] of the repeated piece of road: two dashes of the lane mark
inline constexpr double kBlockLength = 120.0;  // [m] of roadside
inline constexpr int kBlocks = 6;              // that exist; block k of the road looks like block k mod 6
inline constexpr double kRiseFrom = 480.0;     // [m] ahead: a block that comes into the world is still below ground
inline constexpr double kRiseTo = 330.0;       // [m] ahead: and stands on it from here on
inline constexpr double kSunk = -14.0;         // [m] deeper than the highest thing beside the road

// All arithmetic on the distance is in double and wrapped before anything becomes a float: 1e6 m on, a step of a
// millimetre is still a millimetre.

// How far the strip of tiles is moved back: 0 to kTileLength. [m]
double tile_shift(double distance) noexcept;

// Which piece of the road block `block` shows, and where its near end lies: ahead +. A block is taken from behind the
// car to its far end as soon as the car is a whole block past it; in reverse the other way round.
struct BlockPlace {
  std::int64_t index = 0;  // from the start of the road
  double ahead = 0.0;      // [m] near end, -2 to +4 block lengths
  double height = 0.0;     // [m] below 0 while it rises out of the ground far ahead
};
BlockPlace block_place(int block, double distance) noexcept;

// Number in [0, 1) for thing `item` of a block: the same in every run (splitmix64, Steele et al. 2014).
double road_dice(int block, int item) noexcept;

}  // namespace gearshift
