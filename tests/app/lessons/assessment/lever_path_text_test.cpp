// Tests the description in words of the lever's path between two gears, for the shipped gates.
#include "app/lessons/assessment/lever_path_text.h"

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("the path is described: straight, across the aisle with or against the spring, past a lockout") {
  const Gate five = shipped_gate("five_speed_r_right_down");
  CHECK(describe_lever_path(five, 1, 2) == "Straight back.");
  CHECK(describe_lever_path(five, 2, 3) == "Into neutral, let the spring pull the lever across, then forward.");
  CHECK(describe_lever_path(five, 2, 4) == "Into neutral, let the spring pull the lever across, then back.");
  CHECK(describe_lever_path(five, 4, 5) == "Into neutral, to the right against the spring, then forward.");
  CHECK(describe_lever_path(five, 3, 2) == "Into neutral, to the left against the spring, then back.");
  CHECK(describe_lever_path(five, kNeutralGear, 1) == "To the left against the spring, then forward.");
  CHECK(describe_lever_path(five, kNeutralGear, 4) == "Back.");
  CHECK(describe_lever_path(five, 5, kNeutralGear) == "Pull the lever into neutral and let go.");
  const Gate dog_leg = shipped_gate("dog_leg_five");  // in this gate, second is where third usually is
  CHECK(describe_lever_path(dog_leg, 1, 2) == "Into neutral, let the spring pull the lever across, then forward.");
  CHECK(describe_lever_path(dog_leg, 2, 3) == "Straight back.");
  CHECK(describe_lever_path(dog_leg, kNeutralGear, 1).find("then back.") != std::string::npos);
  const Gate six = shipped_gate("six_speed_r_left_up");
  CHECK(describe_lever_path(six, 5, 6) == "Straight back.");
  CHECK(describe_lever_path(six, kNeutralGear, kReverseGear) ==
        "Lift the ring: to the left against the spring, then forward.");
  const Gate open = shipped_gate("open_gate_six");  // no spring
  CHECK(describe_lever_path(open, 2, 3) == "Into neutral, to the right, then forward.");
  const Gate pushed = shipped_gate("six_speed_r_left_down");
  CHECK(describe_lever_path(pushed, kNeutralGear, kReverseGear) ==
        "Hold the knob down: to the left against the spring, then back.");
}
