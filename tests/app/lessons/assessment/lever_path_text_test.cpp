// The lever's path in words, for the shipped gates as their files define them.
#include "app/lessons/assessment/lever_path_text.h"

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("the lever's path is described for the gate: straight, across with or against the spring, past a lock") {
  const Gate five = shipped_gate("five_speed_r_right_down");
  CHECK(describe_lever_path(five, 1, 2) == "Straight back.");
  CHECK(describe_lever_path(five, 2, 3) == "Into the aisle, let the spring take it across, then forward.");
  CHECK(describe_lever_path(five, 2, 4) == "Into the aisle, let the spring take it across, then back.");
  CHECK(describe_lever_path(five, 4, 5) == "Into the aisle, right against the spring, then forward.");
  CHECK(describe_lever_path(five, 3, 2) == "Into the aisle, left against the spring, then back.");
  CHECK(describe_lever_path(five, kNeutralGear, 1) == "Left against the spring, then forward.");
  CHECK(describe_lever_path(five, kNeutralGear, 4) == "Back.");
  CHECK(describe_lever_path(five, 5, kNeutralGear) == "Into the aisle, and let go.");
  const Gate dog_leg = shipped_gate("dog_leg_five");  // second is where third usually is
  CHECK(describe_lever_path(dog_leg, 1, 2) == "Into the aisle, let the spring take it across, then forward.");
  CHECK(describe_lever_path(dog_leg, 2, 3) == "Straight back.");
  CHECK(describe_lever_path(dog_leg, kNeutralGear, 1).find("then back.") != std::string::npos);
  const Gate six = shipped_gate("six_speed_r_left_up");
  CHECK(describe_lever_path(six, 5, 6) == "Straight back.");
  CHECK(describe_lever_path(six, kNeutralGear, kReverseGear) ==
        "Lift the ring, left against the spring, then forward.");
  const Gate pushed = shipped_gate("six_speed_r_left_down");
  CHECK(describe_lever_path(pushed, kNeutralGear, kReverseGear) ==
        "Push the knob down, left against the spring, then back.");
}
