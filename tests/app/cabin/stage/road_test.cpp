#include "app/cabin/stage/road.h"

#include <cmath>
#include <set>

#include <doctest/doctest.h>

namespace gearshift::test {

TEST_CASE("the strip of tiles jumps only by whole tiles, forwards and backwards") {
  for (int i = -150; i < 150; ++i) {
    const double distance = 0.37 * i;
    const double shift = cabin::tile_shift(distance);
    CHECK(shift >= 0.0);
    CHECK(shift < cabin::kTileLength);
    CHECK(std::abs(std::remainder(distance - shift, cabin::kTileLength)) < 1e-12);
  }
}

TEST_CASE("every piece of the road from one block behind to four ahead is shown by exactly one block") {
  for (const double start : {0.0, -3000.0, 77.7, 1e6}) {
    for (int i = 0; i < 250; ++i) {
      const double distance = start + 3.3 * i;
      std::set<std::int64_t> shown;
      for (int block = 0; block < cabin::kBlocks; ++block) {
        const cabin::BlockPlace place = cabin::block_place(block, distance);
        CHECK(((place.index % cabin::kBlocks) + cabin::kBlocks) % cabin::kBlocks == block);
        CHECK(place.ahead == doctest::Approx(static_cast<double>(place.index) * cabin::kBlockLength - distance));
        shown.insert(place.index);
      }
      const auto here = static_cast<std::int64_t>(std::floor(distance / cabin::kBlockLength));
      CHECK(shown == std::set<std::int64_t>{here - 1, here, here + 1, here + 2, here + 3, here + 4});
    }
  }
}

TEST_CASE("no block appears or vanishes in view: blocks jump only below the ground or a block behind the car") {
  constexpr double kStep = 0.5;
  for (const double direction : {1.0, -1.0}) {
    int jumps = 0;
    for (int i = -1000; i < 5000; ++i) {
      const double distance = kStep * i;
      for (int block = 0; block < cabin::kBlocks; ++block) {
        const cabin::BlockPlace before = cabin::block_place(block, direction * distance);
        const cabin::BlockPlace after = cabin::block_place(block, direction * (distance + kStep));
        if (before.index == after.index) {
          CHECK(std::abs(before.ahead - after.ahead) == doctest::Approx(kStep));
          CHECK(std::abs(before.height - after.height) < 0.1);
          continue;
        }
        ++jumps;
        for (const cabin::BlockPlace& place : {before, after}) {
          const bool behind = place.ahead + cabin::kBlockLength <= -cabin::kBlockLength + kStep;
          const bool below = place.height < cabin::kHiddenHeight + 0.01;
          CHECK((behind || below));
        }
      }
    }
    CHECK(jumps >= 24);
  }
}

TEST_CASE("after a thousand kilometres, a millimetre of road is still a millimetre on the screen") {
  constexpr double kFar = 1e6, kStep = 0.001;
  const auto before = static_cast<float>(cabin::tile_shift(kFar + 5.0));
  const auto after = static_cast<float>(cabin::tile_shift(kFar + 5.0 + kStep));
  CHECK(std::abs(static_cast<double>(after - before) - kStep) < 1e-5);
  // The distance itself, stored as a float, would not change at all.
  CHECK(static_cast<float>(kFar + 5.0 + kStep) == static_cast<float>(kFar + 5.0));
}

TEST_CASE("the roadside's random numbers are uniform and reproducible") {
  double sum = 0.0;
  std::set<double> values;
  for (int block = 0; block < cabin::kBlocks; ++block) {
    for (int item = 0; item < 1000; ++item) {
      const double value = cabin::road_dice(block, item);
      CHECK(value >= 0.0);
      CHECK(value < 1.0);
      CHECK(value == cabin::road_dice(block, item));
      sum += value;
      values.insert(value);
    }
  }
  CHECK(values.size() == 6000);
  CHECK(sum / 6000.0 == doctest::Approx(0.5).epsilon(0.03));
}

}  // namespace gearshift::test
