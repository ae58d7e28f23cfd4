// A car with a sequential gate: a hand moves the lever, the drum moves the sleeves, and the synchronisers are those of any
// other gate.
#include "app/vehicle/shift_drum.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/app/vehicle/car_run.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

struct SequentialDrive {
  std::vector<int> gears;   // each change of the lever's gear
  std::vector<int> meshed;  // each change of the car's gear
  double grind = 0.0;       // [J]
};

CarSpec sequential_car() {
  CarSpec car = shipped_car("diesel");
  car.gate = kSequentialGate;
  return car;
}

// Shifts through `gears` in order, with constant pedals [1].
SequentialDrive shift_through(const CarStart& from, const std::vector<int>& gears, double clutch, double dwell = 0.6,
                              double throttle = 0.0) {
  const CarSpec car = sequential_car();
  const Gate gate = gate_of(car);
  ShiftStyle style;
  style.dwell_gear = dwell;
  style.dwell_neutral = 0.2;
  style.engaged = from.gear;
  std::vector<HandStroke> strokes{{{0.0, 0.0}, 0.3, 0.0, {}, false, false}};
  for (const HandStroke& stroke : shift_strokes(gate, {0.0, 0.0}, gears, style)) strokes.push_back(stroke);
  ScriptedHand hand(touring_hand({0.0, 0.0}), strokes, 0.001);
  CarRun run(car, from, hand, [clutch, throttle](double) {
    DriverControls feet = clutch_up(throttle);
    feet.pedals.clutch = clutch;
    return feet;
  });
  SequentialDrive result;
  int lever = from.gear, mesh = from.gear;
  while (run.time() < hand.duration() + 0.5) {
    const HapticSnapshot now = run.step();
    if (now.gear != lever) result.gears.push_back(lever = now.gear);
    if (run.state().gear != mesh) result.meshed.push_back(mesh = run.state().gear);
    result.grind += run.state().grind_power * 0.001;
  }
  return result;
}

}  // namespace

TEST_CASE("with the clutch down, one stroke is one gear, from first to sixth and back, without grinding") {
  CarStart start = rolling_in(sequential_car(), 1, 250.0);
  start.running = true;
  const SequentialDrive result = shift_through(start, {6, 1}, 1.0, 1.5);
  CHECK(result.gears == std::vector{2, 3, 4, 5, 6, 5, 4, 3, 2, 1});
  CHECK(result.meshed == std::vector{0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0, 5, 0, 4, 0, 3, 0, 2, 0, 1});
  CHECK(result.grind < 1e-9);
}

TEST_CASE("reverse and neutral come below first, when the car stands") {
  CarStart start;
  start.running = true;
  start.gear = 1;
  const SequentialDrive result = shift_through(start, {kReverseGear, 2}, 1.0, 1.5);
  CHECK(result.gears == std::vector{0, -1, 0, 1, 2});
  CHECK(result.meshed == std::vector{0, -1, 0, 1, 0, 2});
}

TEST_CASE("an engine that pulls at full throttle holds the gear: no stroke takes it out") {
  CarStart start = rolling_in(sequential_car(), 2, 200.0);
  start.running = true;
  const SequentialDrive pulling = shift_through(start, {3}, 0.0, 0.6, 1.0);
  CHECK(pulling.gears.empty());
  CHECK(pulling.meshed.empty());
}

TEST_CASE("the drum: the old sleeve comes out before the new one goes in, and nothing moves on the way back") {
  const Gate gate = shipped_gate(kSequentialGate), sleeves = sleeves_of(gate);
  ShiftDrum drum(gate);
  const int up = slot_of_gear(gate, kNextGear);
  const Slot& slot = slot_of(gate, up);
  LeverInput lever;
  lever.gear = 2;
  CHECK(drum.turn(lever).slot == slot_of_gear(sleeves, 2));
  CHECK(drum.turn(lever).way == 0.0);
  lever.slot = up;
  double before = slot.rest;
  for (lever.depth = 0.007; lever.depth < slot.release_depth; lever.depth += 0.0005) {
    const ShiftDrum::Sleeve sleeve = drum.turn(lever);
    CHECK(sleeve.slot == slot_of_gear(sleeves, 2));
    CHECK(sleeve.way == -1.0);
    CHECK(sleeve.depth <= before);
    CHECK(std::abs(drum.lever_depth(sleeve.depth) - std::max(lever.depth, gate.half_aisle + gate.chamfer)) < 1e-9);
    before = sleeve.depth;
  }
  for (; lever.depth < slot.end; lever.depth += 0.0005) {
    CHECK(drum.turn(lever).slot == slot_of_gear(sleeves, 3));
    CHECK(drum.turn(lever).depth == lever.depth);
  }
  lever.gear = 3;
  for (; lever.depth > 0.007; lever.depth -= 0.0005) {
    CHECK(drum.turn(lever).slot == slot_of_gear(sleeves, 3));
    CHECK(drum.turn(lever).way == 0.0);
    CHECK(drum.turn(lever).depth == slot.rest);
  }
}
