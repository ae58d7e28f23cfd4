// Tests of the sequential gate. The reference is the order of TORCS (src/drivers/human/human.cpp): a press up adds a
// gear, a press down takes one, and neutral may be locked out below first.
#include <cmath>
#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/gate/gear_selector.h"
#include "haptics/gate/lockout.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kCycle = 0.001;
constexpr double kLong = 0.05;  // [s] longer than the debounce time

// Drum, lockouts and a lever that is held at depths of a slot.
struct SequentialBench {
  explicit SequentialBench(const Gate& a_gate, int start = kNeutralGear)
      : gate(a_gate), selector(0.010, start), at(0.0) {
    hold(kNextGear, 0.0);  // a lever that is in a slot at the start changes no gear
  }

  // Returns false if the slot's mouth was closed when the lever was in the aisle.
  bool hold(int stroke, double depth, double seconds = kLong) {
    const Slot& slot = slot_of(gate, slot_of_gear(gate, stroke));
    const dvec2 p{0.0, static_cast<int>(slot.side) * depth};
    const Passage passage = lockouts.update(gate, {pressed, lifted, road_speed, selector.gear()}, at);
    const bool was_closed = (passage.closed >> slot_of_gear(gate, stroke) & 1u) != 0;
    if (was_closed && depth > gate.half_aisle + gate.chamfer) return false;
    at = p;
    for (int i = 0; i < std::lround(seconds / kCycle); ++i) {
      (void)lockouts.update(gate, {pressed, lifted, road_speed, selector.gear()}, p);
      selector.update(gate, p, kCycle);
    }
    return true;
  }
  // One whole stroke: in to the end, and back.
  bool stroke(int direction) {
    const bool is_open = hold(direction, slot_of(gate, 0).end);
    hold(direction, 0.0);
    return is_open;
  }

  Gate gate;
  GearSelector selector;
  Lockouts lockouts;
  dvec2 at;
  bool pressed = false, lifted = false;
  double road_speed = 0.0;
};

// TORCS: up adds one, down takes one unless neutral is locked out and the gear is 1 or lower.
int torcs_gear(int gear, bool up, bool allows_neutral, int top) {
  if (up) return std::min(gear + 1, top);
  if (allows_neutral || gear > 1) return std::max(gear - 1, kReverseGear);
  return gear;
}

Gate parsed(const std::string& text) {
  return compile_gate(parse_gate_layout("name = \"g\"\n" + text, "g.toml"), kPaperWorkspace);
}

std::string refusal_of(const std::string& text) {
  try {
    (void)parsed(text);
  } catch (const FileError& refused) {
    return refused.what();
  }
  return {};
}

}  // namespace

TEST_CASE("strokes in any order shift as in TORCS, with neutral free and with neutral locked out") {
  for (const bool lifts : {true, false}) {
    SequentialBench bench(shipped_gate(kSequentialGate), 1);
    bench.lifted = lifts;
    int expected = 1;
    for (int i = 0, random = 1; i < 400; ++i) {
      random = (random * 1103 + 12345) % 65536;
      const bool up = random % 100 < (i / 20 % 2 == 0 ? 75 : 25);
      expected = torcs_gear(expected, up, lifts, 6);
      bench.stroke(up ? kNextGear : kPreviousGear);
      CHECK(bench.selector.gear() == expected);
    }
  }
}

TEST_CASE("one stroke is one gear, however long it is held, and half a stroke is none") {
  const Gate gate = shipped_gate(kSequentialGate);
  SequentialBench bench(gate, 2);
  const Slot& slot = slot_of(gate, 0);
  bench.hold(kNextGear, slot.end, 5.0);
  CHECK(bench.selector.gear() == 3);
  for (int i = 0; i < 20; ++i) {  // to and fro without a return to the aisle
    bench.hold(kNextGear, slot.release_depth - 0.002);
    bench.hold(kNextGear, slot.end);
  }
  CHECK(bench.selector.gear() == 3);
  bench.hold(kNextGear, 0.0);
  bench.hold(kNextGear, slot.engage_depth - 0.001);
  bench.hold(kNextGear, 0.0);
  CHECK(bench.selector.gear() == 3);
  bench.hold(kNextGear, slot.end, 0.005);  // shorter than the debounce time
  bench.hold(kNextGear, 0.0);
  CHECK(bench.selector.gear() == 3);
  bench.stroke(kNextGear);
  CHECK(bench.selector.gear() == 4);
}

TEST_CASE("the drum ends at reverse and at the top gear; neutral and reverse are locked out on the way down only") {
  const Gate gate = shipped_gate(kSequentialGate);
  SequentialBench top(gate, 6);
  CHECK_FALSE(top.stroke(kNextGear));
  CHECK(top.selector.gear() == 6);
  SequentialBench down(gate, 1);
  CHECK_FALSE(down.stroke(kPreviousGear));
  CHECK(down.selector.gear() == 1);
  down.lifted = true;
  CHECK(down.stroke(kPreviousGear));
  CHECK(down.selector.gear() == kNeutralGear);
  down.road_speed = 25.0 / kKmhPerMps;  // reverse has a lockout of its own
  CHECK_FALSE(down.stroke(kPreviousGear));
  down.road_speed = 0.0;
  down.stroke(kPreviousGear);
  CHECK(down.selector.gear() == kReverseGear);
  CHECK_FALSE(down.stroke(kPreviousGear));
  down.lifted = false;
  CHECK(down.stroke(kNextGear));
  CHECK(down.stroke(kNextGear));
  CHECK(down.selector.gear() == 1);
}

TEST_CASE("a spring of at least 4 N returns the lever from everywhere") {
  const Gate gate = shipped_gate(kSequentialGate);
  const double end = slot_of(gate, 0).end;
  for (double y = -end; y <= end; y += 1e-5) {
    const double back = gate_feel(gate, {0.0, y}).y * (y > 0.0 ? -1.0 : 1.0);
    if (std::abs(y) > gate.half_aisle / 2.0) CHECK(back > 3.999);
  }
}

TEST_CASE("the file: strokes either way, and what is wrong is named") {
  const Gate forward = parsed("[sequential]\ngears = 4\nup = \"forward\"\n");
  CHECK(slot_of(forward, slot_of_gear(forward, kNextGear)).side == Side::forward);
  CHECK(has_gear(forward, kReverseGear));
  CHECK(has_gear(forward, 4));
  CHECK_FALSE(has_gear(forward, 5));
  CHECK(slot_of_gear(forward, 1) == kNoSlot);
  const std::string sequence = "[sequential]\ngears = 4\nup = \"back\"\n";
  CHECK(refusal_of("[sequential]\ngears = 10\nup = \"back\"\n").find("gears") != std::string::npos);
  CHECK(refusal_of("[sequential]\ngears = 1.5\nup = \"back\"\n").find("whole number") != std::string::npos);
  CHECK(refusal_of("[sequential]\ngears = 4\n").find("up") != std::string::npos);
  CHECK(refusal_of(sequence + "[[column]]\nposition_mm = 0\n").find("only column") != std::string::npos);
  CHECK(refusal_of(sequence + "[[lockout]]\ngear = \"2\"\nkind = \"lift\"\n").find("gear") != std::string::npos);
  CHECK(refusal_of(sequence + "[[lockout]]\ngear = \"R\"\nkind = \"after_gear\"\nafter = \"1\"\n").find("kind") !=
        std::string::npos);
  CHECK(refusal_of(sequence + "[[lockout]]\ngear = \"R\"\nkind = \"speed\"\nclose_above_kmh = 5\nopen_below_kmh = 6\n")
            .find("open_below_kmh") != std::string::npos);
  CHECK(refusal_of("[[column]]\nposition_mm = 0\nforward = \"1\"\nneutral = true\n[[lockout]]\ngear = \"N\"\nkind = "
                   "\"lift\"\n")
            .find("gear") != std::string::npos);
}
