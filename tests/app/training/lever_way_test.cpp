// The lever's way in words, in the shipped gates as they are drawn in their files.
#include "app/training/lever_way.h"

#include <doctest/doctest.h>

#include "tests/support/gates.h"

using namespace gearshift;

TEST_CASE("the lever's way is told as the gate is: straight, across with the spring or against it, past what locks") {
  const Gate five = shipped_gate("five_speed_r_right_down");
  CHECK(lever_way(five, 1, 2) == "Straight back.");
  CHECK(lever_way(five, 2, 3) == "Into the aisle, let the spring take it across, then forward.");
  CHECK(lever_way(five, 2, 4) == "Into the aisle, let the spring take it across, then back.");
  CHECK(lever_way(five, 4, 5) == "Into the aisle, right against the spring, then forward.");
  CHECK(lever_way(five, 3, 2) == "Into the aisle, left against the spring, then back.");
  CHECK(lever_way(five, kNeutralGear, 1) == "Left against the spring, then forward.");
  CHECK(lever_way(five, kNeutralGear, 4) == "Back.");
  CHECK(lever_way(five, 5, kNeutralGear) == "Into the aisle, and let go.");
  const Gate dog_leg = shipped_gate("dog_leg_five");  // second is where third is used to be
  CHECK(lever_way(dog_leg, 1, 2) == "Into the aisle, let the spring take it across, then forward.");
  CHECK(lever_way(dog_leg, 2, 3) == "Straight back.");
  CHECK(lever_way(dog_leg, kNeutralGear, 1).find("then back.") != std::string::npos);
  const Gate six = shipped_gate("six_speed_r_left_up");
  CHECK(lever_way(six, 5, 6) == "Straight back.");
  CHECK(lever_way(six, kNeutralGear, kReverseGear) == "Lift the ring, left against the spring, then forward.");
  const Gate pushed = shipped_gate("six_speed_r_left_down");
  CHECK(lever_way(pushed, kNeutralGear, kReverseGear) == "Push the knob down, left against the spring, then back.");
}
