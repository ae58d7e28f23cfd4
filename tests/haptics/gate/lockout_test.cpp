// Tests of movable walls: each kind closes and opens as specified, and never closes while the lever is beyond it.
#include "haptics/gate/lockout.h"

#include <limits>

#include <doctest/doctest.h>

#include "app/lab/random_gates/random_layout.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kKmh = 1.0 / 3.6;

Gate gate_with(Lockout lockout) {
  Gate gate = paper_gate();
  lockout.slot = slot_of_gear(gate, kReverseGear);
  gate.lockout[0] = lockout;
  gate.lockout_count = 1;
  return gate;
}

bool reverse_closed(const Gate& gate, const Passage& passage) {
  return (passage.closed >> slot_of_gear(gate, kReverseGear) & 1u) != 0;
}

}  // namespace

TEST_CASE("push-down and lift: closed, open while held") {
  for (const LockoutKind kind : {LockoutKind::push_down, LockoutKind::lift}) {
    Lockout lockout;
    lockout.kind = kind;
    const Gate gate = gate_with(lockout);
    Lockouts lockouts;
    LockoutInputs in;
    CHECK(reverse_closed(gate, lockouts.update(gate, in, {0.0, 0.0})));
    (kind == LockoutKind::push_down ? in.pressed_down : in.lifted) = true;
    CHECK_FALSE(reverse_closed(gate, lockouts.update(gate, in, {0.0, 0.0})));
    in = {};
    (kind == LockoutKind::push_down ? in.lifted : in.pressed_down) = true;  // the wrong button
    CHECK(reverse_closed(gate, lockouts.update(gate, in, {0.0, 0.0})));
  }
}

TEST_CASE("reverse closes above 20 km/h and opens below 15 km/h, forwards and backwards") {
  Lockout lockout;
  lockout.kind = LockoutKind::speed;
  lockout.close_above = 20.0 * kKmh;
  lockout.open_below = 15.0 * kKmh;
  const Gate gate = gate_with(lockout);
  Lockouts lockouts;
  const auto closed_at = [&](double kmh) {
    LockoutInputs in;
    in.road_speed = kmh * kKmh;
    return reverse_closed(gate, lockouts.update(gate, in, {0.0, 0.0}));
  };
  CHECK_FALSE(closed_at(0.0));
  CHECK_FALSE(closed_at(19.9));
  CHECK(closed_at(20.1));
  CHECK(closed_at(15.1));
  CHECK_FALSE(closed_at(14.9));
  CHECK_FALSE(closed_at(19.9));
  CHECK(closed_at(-20.1));
}

TEST_CASE("no direct 5 to R: closed from 5th until the lever has left the column") {
  Lockout lockout;
  lockout.kind = LockoutKind::after_gear;
  lockout.after_gear = 5;
  const Gate gate = gate_with(lockout);
  Lockouts lockouts;
  const dvec2 fifth = rest_position(gate, 5);
  LockoutInputs in;
  CHECK_FALSE(reverse_closed(gate, lockouts.update(gate, in, {fifth.x, 0.0})));  // straight from neutral
  in.gear = 5;
  CHECK(reverse_closed(gate, lockouts.update(gate, in, fifth)));
  in.gear = kNeutralGear;
  CHECK(reverse_closed(gate, lockouts.update(gate, in, {fifth.x, 0.0})));
  CHECK_FALSE(reverse_closed(gate, lockouts.update(gate, in, {0.0, 0.0})));
  CHECK_FALSE(reverse_closed(gate, lockouts.update(gate, in, {fifth.x, 0.0})));
}

TEST_CASE("a wall never closes while the lever is beyond it") {
  Lockout lockout;
  lockout.kind = LockoutKind::push_down;
  const Gate gate = gate_with(lockout);
  Lockouts lockouts;
  CHECK_FALSE(reverse_closed(gate, lockouts.update(gate, {}, rest_position(gate, kReverseGear))));
}

TEST_CASE("beyond a mouth's wall means past the chamfer: in the mouth the wall still closes") {
  Lockout lockout;
  lockout.kind = LockoutKind::push_down;
  const Gate gate = gate_with(lockout);
  Lockouts state;
  const double x = rest_position(gate, kReverseGear).x, y = rest_position(gate, kReverseGear).y > 0.0 ? 1.0 : -1.0;
  const double mouth = gate.half_aisle + gate.chamfer;
  CHECK(reverse_closed(gate, state.update(gate, {}, {x, y * (mouth - 1e-6)})));
  CHECK_FALSE(reverse_closed(gate, state.update(gate, {}, {x, y * (mouth + 1e-6)})));
}

TEST_CASE("no direct 5 to R: the lever has left the column only when it is outside the mouth, not before") {
  Lockout lockout;
  lockout.kind = LockoutKind::after_gear;
  lockout.after_gear = 5;
  const Gate gate = gate_with(lockout);
  const Column& column = column_of(gate, slot_of(gate, slot_of_gear(gate, 5)).column);
  const double edge = column.half_width + gate.chamfer;
  Lockouts state;
  LockoutInputs in;
  in.gear = 5;
  state.update(gate, in, rest_position(gate, 5));
  in.gear = kNeutralGear;
  CHECK(reverse_closed(gate, state.update(gate, in, {column.center - edge + 1e-6, 0.0})));
  CHECK_FALSE(reverse_closed(gate, state.update(gate, in, {column.center - edge - 1e-6, 0.0})));
}

TEST_CASE("two lockouts of one gear have separate states: the gear is open only if both are") {
  Lockout speed;
  speed.kind = LockoutKind::speed;
  speed.close_above = 20.0 * kKmh;
  speed.open_below = 15.0 * kKmh;
  Gate gate = gate_with(speed);
  gate.lockout[1] = gate.lockout[0];
  gate.lockout[1].kind = LockoutKind::after_gear;
  gate.lockout[1].after_gear = 5;
  gate.lockout_count = 2;
  const double x = rest_position(gate, 5).x;
  Lockouts state;
  LockoutInputs in;
  in.gear = 5;
  // 17 km/h is between `open_below` and `close_above`, so the speed lockout stays open. The after-gear lockout is
  // closed until the lever has left the mouth of fifth gear.
  in.road_speed = 17.0 * kKmh;
  CHECK(reverse_closed(gate, state.update(gate, in, rest_position(gate, 5))));
  in.gear = kNeutralGear;
  CHECK(reverse_closed(gate, state.update(gate, in, {x, 0.0})));
  CHECK_FALSE(reverse_closed(gate, state.update(gate, in, {0.0, 0.0})));
  in.road_speed = 25.0 * kKmh;
  CHECK(reverse_closed(gate, state.update(gate, in, {0.0, 0.0})));
  in.road_speed = std::numeric_limits<double>::quiet_NaN();  // a speed of NaN leaves the state unchanged
  CHECK(reverse_closed(gate, state.update(gate, in, {0.0, 0.0})));
}

TEST_CASE("a lateral lockout narrows the neutral aisle on its side only") {
  Lockout lockout;
  lockout.lateral = true;
  lockout.barrier = 0.020;
  lockout.beyond = 1;
  const Gate gate = gate_with(lockout);
  Lockouts lockouts;
  const Passage closed = lockouts.update(gate, {}, {0.0, 0.0});
  CHECK(closed.select_max == 0.020);
  CHECK(closed.select_min == gate.select_min);
  CHECK(lockouts.update(gate, {}, {0.021, 0.0}).select_max == gate.select_max);
}

TEST_CASE("a lockout never closes on a lever pressed against its slot's side, despite rounding: 500 random gates") {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    CAPTURE(seed);
    const Gate gate = compile_gate(random_layout(seed), kPaperWorkspace);
    for (const Lockout& lockout : lockouts(gate)) {
      if (lockout.lateral) continue;
      const Slot& slot = slot_of(gate, lockout.slot);
      const Column& column = column_of(gate, slot.column);
      for (const double x : {column.center - column.half_width, column.center + column.half_width}) {
        Lockouts memory;
        const LockoutInputs nothing{false, false, 100.0, lockout.after_gear};
        const Passage passage = memory.update(gate, nothing, {x, static_cast<int>(slot.side) * slot.rest});
        CHECK((passage.closed >> lockout.slot & 1u) == 0);
      }
    }
  }
}
