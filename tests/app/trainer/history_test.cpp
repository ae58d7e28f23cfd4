// Thinning keeps order, number and peaks.
#include "app/trainer/history.h"

#include <random>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

std::vector<HapticSnapshot> pushes(const std::vector<double>& newtons) {
  std::vector<HapticSnapshot> all;
  for (const double push : newtons) {
    HapticSnapshot snapshot;
    snapshot.cycle = all.size();
    snapshot.f_h.x = push;
    all.push_back(snapshot);
  }
  return all;
}

}  // namespace

TEST_CASE("what fits is kept whole") {
  const auto all = pushes({1, 2, 3});
  CHECK(thinned(all, 3).size() == 3);
  CHECK(thinned(all, 100).size() == 3);
  CHECK(thinned({}, 5).empty());
}

TEST_CASE("a single peak and a single pause survive any thinning") {
  std::mt19937 chance(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> newtons(3 + chance() % 3000, 5.0);
    const std::size_t peak = chance() % newtons.size(), pause = chance() % newtons.size();
    newtons[pause] = 1.0;
    newtons[peak] = -60.0;  // a push to the left is one, too
    const auto all = pushes(newtons);
    const std::size_t most = 2 + chance() % 100;
    const auto few = thinned(all, most);
    CHECK(few.size() <= most);
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

TEST_CASE("the parts are even: no two neighbours are further apart than two parts") {
  std::mt19937 chance(3);
  std::vector<double> newtons(10'000);
  for (double& push : newtons) push = static_cast<double>(chance() % 1000);
  const auto few = thinned(pushes(newtons), 200);
  CHECK(few.size() == 200);
  for (std::size_t i = 1; i < few.size(); ++i) CHECK(few[i].cycle - few[i - 1].cycle <= 200);  // 100 parts of 100
}

TEST_CASE("one is the strongest, none is none") {
  const auto all = pushes({1, -7, 3});
  REQUIRE(thinned(all, 1).size() == 1);
  CHECK(thinned(all, 1)[0].cycle == 1);
  CHECK(thinned(all, 0).empty());
}
