// The road and the roadside. The car stays at the world's origin; the road moves backwards.
#pragma once

#include <cstdint>

namespace gearshift::cabin {

inline constexpr double kTileLength = 12.0;     // [m] of the repeated road tile: two dashes of the lane marking
inline constexpr double kBlockLength = 120.0;   // [m] of a roadside block
inline constexpr int kBlocks = 6;               // distinct blocks; block k of the road looks like block k mod 6
inline constexpr double kRiseFrom = 480.0;      // [m] ahead: beyond this, a new block is below ground
inline constexpr double kRiseTo = 330.0;        // [m] ahead: closer than this, it is at ground level
inline constexpr double kHiddenHeight = -14.0;  // [m] deeper than the tallest roadside object

// Distances are computed in double and wrapped before conversion to float, so that a step of 1 mm is still 1 mm after
// 1e6 m.

// Backward displacement of the strip of tiles: 0 to kTileLength. [m]
double tile_shift(double distance) noexcept;

// Which part of the road `block` shows, and where it is. A block moves from behind the car to the far end of the road
// as soon as the car is a whole block past it; in reverse the other way round.
struct BlockPlace {
  std::int64_t index = 0;  // from the start of the road
  double ahead = 0.0;      // [m] of the near end, positive ahead, -2 to +4 block lengths
  double height = 0.0;     // [m] below 0 while it rises out of the ground far ahead
};
BlockPlace block_place(int block, double distance) noexcept;

// Pseudo-random number in [0, 1) for `item` of a block, the same in every run (splitmix64, Steele et al. 2014).
double road_dice(int block, int item) noexcept;

}  // namespace gearshift::cabin
