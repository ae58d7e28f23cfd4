#include "app/cabin/stage/road.h"

#include <algorithm>
#include <cmath>

namespace gearshift::cabin {

double tile_shift(double distance) noexcept {
  return distance - std::floor(distance / kTileLength) * kTileLength;
}

BlockPlace block_place(int block, double distance) noexcept {
  // The first displayed block is the one behind the block in which the car is.
  const auto first = static_cast<std::int64_t>(std::floor(distance / kBlockLength)) - 1;
  const std::int64_t ahead_of_first = ((block - first) % kBlocks + kBlocks) % kBlocks;
  BlockPlace place;
  place.index = first + ahead_of_first;
  place.ahead = static_cast<double>(place.index) * kBlockLength - distance;
  const double t = std::clamp((place.ahead - kRiseTo) / (kRiseFrom - kRiseTo), 0.0, 1.0);
  place.height = kHiddenHeight * t * t * (3.0 - 2.0 * t);
  return place;
}

double road_dice(int block, int item) noexcept {
  std::uint64_t z = (static_cast<std::uint64_t>(block) << 32) + static_cast<std::uint64_t>(item);
  z = (z + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

}  // namespace gearshift::cabin
