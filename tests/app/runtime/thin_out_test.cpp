// Downsampling keeps the order and the peaks, and returns at most the requested number of points.
#include "app/runtime/thin_out.h"

#include <random>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::vehicle;

namespace {

std::vector<DriveSample> pushes(const std::vector<double>& newtons) {
  std::vector<DriveSample> all;
  for (const double push : newtons) {
    DriveSample& sample = all.emplace_back();
    sample.lever.cycle = all.size() - 1;
    sample.lever.f_h.x = push;
  }
  return all;
}

std::vector<HapticSnapshot> thinned(const std::vector<DriveSample>& all, std::size_t max_count) {
  std::vector<HapticSnapshot> few(3);  // replaced
  thin_out(all, max_count, few);
  return few;
}

}  // namespace

TEST_CASE("data within the limit is kept completely") {
  const auto all = pushes({1, 2, 3});
  CHECK(thinned(all, 3).size() == 3);
  CHECK(thinned(all, 100).size() == 3);
  CHECK(thinned({}, 5).empty());
}

TEST_CASE("a single peak and a single gap survive any downsampling") {
  std::mt19937 chance(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> newtons(3 + chance() % 3000, 5.0);
    const std::size_t peak = chance() % newtons.size(), pause = chance() % newtons.size();
    newtons[pause] = 1.0;
    newtons[peak] = -60.0;  // a push to the left is negative, but also a peak
    const auto all = pushes(newtons);
    const std::size_t limit = 2 + chance() % 100;
    const auto few = thinned(all, limit);
    CHECK(few.size() <= limit);
    CHECK_FALSE(few.empty());
    bool has_peak = false, has_pause = peak == pause;
    for (std::size_t i = 0; i < few.size(); ++i) {
      if (i > 0) CHECK(few[i].cycle > few[i - 1].cycle);
      has_peak = has_peak || few[i].cycle == peak;
      has_pause = has_pause || few[i].cycle == pause;
    }
    CHECK(has_peak);
    CHECK(has_pause);
  }
}

TEST_CASE("the intervals are even: neighbours are at most two intervals apart") {
  std::mt19937 chance(3);
  std::vector<double> newtons(10'000);
  for (double& push : newtons) push = static_cast<double>(chance() % 1000);
  const auto few = thinned(pushes(newtons), 200);
  CHECK(few.size() == 200);
  // There are 100 intervals of 100 cycles with two points each, so neighbours are at most 200 cycles apart.
  for (std::size_t i = 1; i < few.size(); ++i) CHECK(few[i].cycle - few[i - 1].cycle <= 200);
}

TEST_CASE("one point keeps the strongest, zero keeps none") {
  const auto all = pushes({1, -7, 3});
  REQUIRE(thinned(all, 1).size() == 1);
  CHECK(thinned(all, 1)[0].cycle == 1);
  CHECK(thinned(all, 0).empty());
}
