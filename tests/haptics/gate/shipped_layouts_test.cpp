// Tests that the gates shipped with the program have the right gears and fit the paper's joystick.
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/haptics/gate/gate_laws.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using doctest::Approx;

namespace {

// A gate as engraved on the shift knob: its forward row and its back row of gears, with '-' for no gear.
struct ShippedGate {
  const char* name;
  const char* forward;
  const char* back;
  int lateral;  // number of lockouts across the neutral aisle
  int mouth;    // number of lockouts in the mouth of a slot
};

constexpr ShippedGate kShippedGates[] = {
    {"paper", "135", "24R", 0, 0},
    {"five_speed_r_left_up", "R135", "-24-", 2, 0},
    {"five_speed_r_right_down", "135", "24R", 0, 2},
    {"six_speed_r_left_up", "R135", "-246", 2, 0},
    {"six_speed_r_left_down", "-135", "R246", 2, 0},
    {"six_speed_r_right_down", "135-", "246R", 1, 0},
    {"dog_leg_five", "R24", "135", 0, 2},
    {"four_speed", "-13", "R24", 2, 0},
    {"six_speed_r_left_spring", "R135", "-246", 1, 0},
    {"open_gate_six", "R135", "-246", 2, 0},
    {"seven_speed", "R1357", "-246-", 2, 0},
    {"three_on_the_tree", "R2", "13", 0, 1},
    {"sequential_six", "-", "+", 0, 3},
};

std::string row(const Gate& gate, Side side) {
  std::string gears;
  for (const Column& column : columns(gate)) {
    const int slot = side == Side::forward ? column.forward_slot : column.back_slot;
    gears += slot == kNoSlot ? "-" : gear_name(slot_of(gate, slot).gear);
  }
  return gears;
}

}  // namespace

TEST_CASE("every shipped gate has the gears where a driver expects them") {
  for (const ShippedGate& expected_gate : kShippedGates) {
    CAPTURE(expected_gate.name);
    const Gate gate = shipped_gate(expected_gate.name);
    CHECK(row(gate, Side::forward) == expected_gate.forward);
    CHECK(row(gate, Side::back) == expected_gate.back);
    int lateral = 0;
    for (const Lockout& lockout : lockouts(gate)) lateral += lockout.lateral;
    CHECK(lateral == expected_gate.lateral);
    CHECK(gate.lockout_count - lateral == expected_gate.mouth);
  }
}

TEST_CASE("every shipped gate is listed here and in the program") {
  std::set<std::string> expected, found;
  for (const ShippedGate& expected_gate : kShippedGates) expected.insert(expected_gate.name);
  for (const auto& entry : std::filesystem::directory_iterator(GEARSHIFT_ASSETS "/gates")) {
    if (entry.path().extension() == ".toml") found.insert(entry.path().stem().string());
  }
  for (const char* name : kMechanisms) expected.insert(name);
  CHECK(found == expected);
  auto names = shipped_names();
  names.emplace_back(kSequentialGate);
  names.insert(names.end(), std::begin(kMechanisms), std::end(kMechanisms));
  CHECK(std::set<std::string>(names.begin(), names.end()) == expected);
}

TEST_CASE("every corner of every shipped gate is inside the exact workspace, pressed 6.3 mm into both walls") {
  for (const ShippedGate& expected_gate : kShippedGates) {
    CAPTURE(expected_gate.name);
    const Gate gate = shipped_gate(expected_gate.name);
    for (const Slot& slot : slots(gate)) {
      const Column& column = column_of(gate, slot.column);
      CHECK(yoke_reaches({std::abs(column.center) + column.half_width + 0.0063, slot.end + 0.0063}));
    }
  }
}

TEST_CASE("all forces of the shipped gates are far below the clamp of 31.7 N") {
  for (const ShippedGate& expected_gate : kShippedGates) {
    CAPTURE(expected_gate.name);
    const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + std::string(expected_gate.name) + ".toml");
    CHECK(layout.feel.lock_force + layout.feel.center_force <= 16.0);
    CHECK(layout.feel.detent_force < layout.feel.lock_force);
  }
}

TEST_CASE("every shipped speed lockout closes above 20 and opens below 15 km/h") {
  for (const ShippedGate& expected_gate : kShippedGates) {
    CAPTURE(expected_gate.name);
    const Gate gate = shipped_gate(expected_gate.name);
    for (const Lockout& lockout : lockouts(gate)) {
      if (lockout.kind != LockoutKind::speed) continue;
      CHECK(lockout.close_above * 3.6 == Approx(20.0));
      CHECK(lockout.open_below * 3.6 == Approx(15.0));
      CHECK(gear_behind(gate, lockout.slot, kNeutralGear) == kReverseGear);
    }
  }
}

TEST_CASE("on the chamfers of every shipped gate the forces do not depend on where the lever is") {
  for (const ShippedGate& expected_gate : kShippedGates) {
    CAPTURE(expected_gate.name);
    check_constant_at_mouths(shipped_gate(expected_gate.name));
  }
}
