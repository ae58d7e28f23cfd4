// Tests of gear selection. They cover known bugs of similar software: flicker, a gear that stays engaged in neutral,
// two gears engaged at once.
#include "haptics/gate/gear_selector.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kPeriod = 0.001;
constexpr double kDebounce = 0.010;

const Slot& slot_with(const Gate& gate, int gear) {
  return slot_of(gate, slot_of_gear(gate, gear));
}

dvec2 at_depth(const Gate& gate, int gear, double depth) {
  const Slot& slot = slot_with(gate, gear);
  return {column_of(gate, slot.column).center, static_cast<int>(slot.side) * depth};
}

int hold(GearSelector& selector, const Gate& gate, dvec2 p, double seconds) {
  const int cycles = static_cast<int>(std::lround(seconds / kPeriod));
  for (int i = 0; i < cycles; ++i) selector.update(gate, p, kPeriod);
  return selector.gear();
}

}  // namespace

TEST_CASE("no flicker: tremor of a millimetre about either threshold changes the gear once at most") {
  const Gate gate = paper_gate();
  for (const double depth : {slot_with(gate, 1).engage_depth, slot_with(gate, 1).release_depth}) {
    GearSelector selector(kDebounce);
    hold(selector, gate, at_depth(gate, 1, slot_with(gate, 1).rest), 0.1);
    int changes = 0, before = selector.gear();
    for (int i = 0; i < 2000; ++i) {
      const int gear = selector.update(gate, at_depth(gate, 1, depth + (i % 7 < 3 ? -0.5e-3 : 0.5e-3)), kPeriod);
      changes += gear != before;
      before = gear;
    }
    CHECK(changes <= 1);
  }
}

TEST_CASE("a gear is engaged after the debounce time and not before") {
  const Gate gate = paper_gate();
  GearSelector selector(kDebounce);
  const dvec2 in_second = at_depth(gate, 2, slot_with(gate, 2).rest);
  CHECK(hold(selector, gate, in_second, kDebounce - 2.0 * kPeriod) == kNeutralGear);
  CHECK(hold(selector, gate, in_second, 4.0 * kPeriod) == 2);
}

TEST_CASE("a gear is released after the debounce time and not before: a single outlier does not release it") {
  const Gate gate = paper_gate();
  GearSelector selector(kDebounce);
  REQUIRE(hold(selector, gate, rest_position(gate, 2), 0.1) == 2);
  CHECK(hold(selector, gate, {0.0, 0.0}, kDebounce - 2.0 * kPeriod) == 2);
  CHECK(hold(selector, gate, rest_position(gate, 2), kPeriod) == 2);
  CHECK(hold(selector, gate, {0.0, 0.0}, kDebounce + 2.0 * kPeriod) == kNeutralGear);
}

TEST_CASE("between release and engage depth of another slot an engaged gear is not kept") {
  const Gate gate = paper_gate();
  GearSelector selector(kDebounce);
  REQUIRE(hold(selector, gate, rest_position(gate, 1), 0.1) == 1);
  const Slot& third = slot_of(gate, slot_of_gear(gate, 3));
  const glm::dvec2 between{rest_position(gate, 3).x, 0.5 * (third.release_depth + third.engage_depth)};
  CHECK(hold(selector, gate, between, 0.1) == kNeutralGear);
}

TEST_CASE("no hang after neutral: back in the aisle the gear is gone within the debounce time") {
  const Gate gate = paper_gate();
  for (const int gear : {1, 2, 3, 4, 5, kReverseGear}) {
    GearSelector selector(kDebounce);
    REQUIRE(hold(selector, gate, rest_position(gate, gear), 0.1) == gear);
    CHECK(hold(selector, gate, {rest_position(gate, gear).x, 0.0}, kDebounce + 2.0 * kPeriod) == kNeutralGear);
  }
}

TEST_CASE("no double engagement: two gears in a row never without neutral in between") {
  const Gate gate = paper_gate();
  GearSelector selector(0.0);
  int before = hold(selector, gate, rest_position(gate, 1), 0.1);
  REQUIRE(before == 1);
  for (const int gear : {2, 3, 4, 5, kReverseGear, 1}) {
    std::vector<int> gears;
    const dvec2 from = rest_position(gate, before), to = rest_position(gate, gear);
    const dvec2 path[] = {from, {from.x, 0.0}, {to.x, 0.0}, to};
    for (int leg = 0; leg < 3; ++leg) {
      for (int i = 0; i <= 100; ++i) {
        gears.push_back(selector.update(gate, path[leg] + (path[leg + 1] - path[leg]) * (i / 100.0), kPeriod));
      }
    }
    CHECK(std::count(gears.begin(), gears.end(), kNeutralGear) > 0);
    CHECK(std::set<int>(gears.begin(), gears.end()) == std::set<int>{before, kNeutralGear, gear});
    before = gear;
  }
}
