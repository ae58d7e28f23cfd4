// Positions of road and roadside. The car stays at the world's origin, and the road moves backwards.
#pragma once

#include <cstdint>

namespace gearshift::cabin {

inline constexpr double kTileLength = 12.0;     // [m] length of the repeated road tile: two dashes of the lane marking
inline constexpr double kBlockLength = 120.0;   // [m] length of a roadside block
inline constexpr int kBlocks = 6;               // number of distinct blocks; block k looks like block k mod 6
inline constexpr double kRiseFrom = 480.0;      // [m] a block further ahead than this is hidden below ground
inline constexpr double kRiseTo = 330.0;        // [m] a block nearer than this is at ground level
inline constexpr double kHiddenHeight = -14.0;  // [m] height of a hidden block, so low that nothing of it is visible

// The functions below compute in double and wrap distances before they are converted to float, so that a movement of 1
// mm is still 1 mm after 1e6 m.

// Backward displacement [m] of the strip of tiles, 0 to kTileLength. distance [m]: driven by the car.
double tile_shift(double distance) noexcept;

// The part of the road that a block shows, and the block's position. A block moves from behind the car to the far end
// of the road as soon as the car is more than a whole block past that block; in reverse, blocks move the other way.
struct BlockPlace {
  std::int64_t index = 0;  // number of the block, counted from the start of the road
  double ahead = 0.0;      // [m] from the car to the block's near end, -2 to +4 block lengths
  double height = 0.0;     // [m] negative while the block, far ahead, rises out of the ground
};
BlockPlace block_place(int block, double distance) noexcept;

// Pseudo-random number from 0 (included) to 1 (excluded) for `item` of a block, the same in every run (splitmix64,
// Steele et al. 2014).
double road_dice(int block, int item) noexcept;

}  // namespace gearshift::cabin
