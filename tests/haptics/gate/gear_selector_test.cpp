// Which gear is in. The tests are the peers' bug list: flicker, hang after neutral, double engagement,
// ejection.
#include "haptics/gate/gear_selector.h"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift;
using glm::dvec2;

namespace {

constexpr double kPeriod = 0.001;
constexpr double kDebounce = 0.010;

const Slot& slot_of(const Gate& gate, int gear) {
  return gate.slot[static_cast<std::size_t>(slot_of_gear(gate, gear))];
}

dvec2 at_depth(const Gate& gate, int gear, double depth) {
  const Slot& slot = slot_of(gate, gear);
  return {gate.column[static_cast<std::size_t>(slot.column)].center, static_cast<int>(slot.side) * depth};
}

int hold(GearSelector& selector, const Gate& gate, dvec2 p, double seconds) {
  int gear = selector.gear();
  for (double t = 0.0; t < seconds; t += kPeriod) gear = selector.update(gate, p, kPeriod);
  return gear;
}

}  // namespace

TEST_CASE("no flicker: tremor of a millimetre about either threshold changes the gear once at most") {
  const Gate gate = paper_gate();
  for (const double depth : {slot_of(gate, 1).engage_depth, slot_of(gate, 1).release_depth}) {
    GearSelector selector(kDebounce);
    hold(selector, gate, at_depth(gate, 1, slot_of(gate, 1).rest), 0.1);
    int changes = 0, before = selector.gear();
    for (int i = 0; i < 2000; ++i) {
      const int gear =
          selector.update(gate, at_depth(gate, 1, depth + (i % 7 < 3 ? -0.5e-3 : 0.5e-3)), kPeriod);
      changes += gear != before;
      before = gear;
    }
    CHECK(changes <= 1);
  }
}

TEST_CASE("a gear counts after the debounce time and not before") {
  const Gate gate = paper_gate();
  GearSelector selector(kDebounce);
  const dvec2 in_second = at_depth(gate, 2, slot_of(gate, 2).rest);
  CHECK(hold(selector, gate, in_second, kDebounce - 2.0 * kPeriod) == kNeutralGear);
  CHECK(hold(selector, gate, in_second, 4.0 * kPeriod) == 2);
}

TEST_CASE("no hang after neutral: back in the aisle the gear is gone within the debounce time") {
  const Gate gate = paper_gate();
  for (const int gear : {1, 2, 3, 4, 5, kReverseGear}) {
    GearSelector selector(kDebounce);
    REQUIRE(hold(selector, gate, rest_position(gate, gear), 0.1) == gear);
    CHECK(hold(selector, gate, {rest_position(gate, gear).x, 0.0}, kDebounce + 2.0 * kPeriod) ==
          kNeutralGear);
  }
}

TEST_CASE("no double engagement: two gears in a row never without neutral in between") {
  const Gate gate = paper_gate();
  GearSelector selector(0.0);
  int before = hold(selector, gate, rest_position(gate, 1), 0.1);
  REQUIRE(before == 1);
  for (const int gear : {2, 3, 4, 5, kReverseGear, 1}) {
    std::vector<int> seen;
    const dvec2 from = rest_position(gate, before), to = rest_position(gate, gear);
    const dvec2 path[] = {from, {from.x, 0.0}, {to.x, 0.0}, to};
    for (int leg = 0; leg < 3; ++leg) {
      for (int i = 0; i <= 100; ++i) {
        seen.push_back(selector.update(gate, path[leg] + (path[leg + 1] - path[leg]) * (i / 100.0), kPeriod));
      }
    }
    CHECK(std::count(seen.begin(), seen.end(), kNeutralGear) > 0);
    CHECK(std::set<int>(seen.begin(), seen.end()) == std::set<int>{before, kNeutralGear, gear});
    before = gear;
  }
}

TEST_CASE("no ejection: a lever held by the lock alone stays in gear under 90 % of the pull-out force") {
  const Gate gate = paper_gate();
  for (int i = 0; i < gate.slot_count; ++i) {
    const Slot& slot = gate.slot[static_cast<std::size_t>(i)];
    double depth = slot.rest;
    double strongest = 0.0;
    for (double s = slot.rest; s > slot.release_depth; s -= 1e-5)
      strongest = std::max(strongest, feel_force(slot.feel, s));
    while (feel_force(slot.feel, depth) < 0.9 * strongest)
      depth -= 1e-6;  // where the lock balances that pull
    CHECK(depth > slot.release_depth);
  }
}
