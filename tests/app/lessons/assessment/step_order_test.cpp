// Tests the order of pedal and lever movements in a shift: the number of misplaced steps, and the name of the first
// mistake.
#include "app/lessons/assessment/step_order.h"

#include <cstddef>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using S = ShiftStep;

TEST_CASE("the taught order omits steps that a shift does not need") {
  CHECK(taught_steps(2, 3) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::gear, S::clutch_up, S::throttle_on});
  CHECK(taught_steps(kNeutralGear, 1) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::gear, S::clutch_up, S::throttle_on});
  CHECK(taught_steps(1, kNeutralGear) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::throttle_on});
}

TEST_CASE("the taught order has no misplaced step, with or without throttle at the end") {
  const std::vector<S> all_steps = taught_steps(2, 3);
  CHECK(steps_out_of_place(all_steps, 2, 3) == 0);
  CHECK(steps_out_of_place(std::span(all_steps).first(5), 2, 3) == 0);
}

TEST_CASE("a blip is accepted anywhere in a shift into a lower gear, and not into a higher one") {
  const std::vector<S> blips[] = {
      {S::throttle_off, S::clutch_down, S::throttle_on, S::throttle_off, S::neutral, S::gear, S::clutch_up},
      {S::throttle_off, S::clutch_down, S::throttle_on, S::neutral, S::gear, S::throttle_off, S::clutch_up},
      {S::throttle_off, S::clutch_down, S::neutral, S::throttle_on, S::throttle_off, S::gear, S::clutch_up},
      {S::throttle_off, S::clutch_down, S::neutral, S::gear, S::throttle_on, S::throttle_off, S::clutch_up}};
  for (std::vector<S> steps : blips) {
    CHECK(steps_out_of_place(steps, 3, 2) == 0);
    CHECK(steps_out_of_place(steps, 2, 3) == 2);
    steps.push_back(S::throttle_on);
    CHECK(steps_out_of_place(steps, 3, 2) == 0);
  }
  // A second blip in one shift is out of place.
  std::vector<S> two = blips[0];
  two.insert(two.end() - 1, {S::throttle_on, S::throttle_off});
  CHECK(steps_out_of_place(two, 3, 2) == 2);
}

TEST_CASE("a blip into a lower gear may last until the clutch is up or longer; the clutch is required") {
  const std::vector<S> held{S::throttle_off, S::clutch_down, S::neutral, S::gear, S::throttle_on, S::clutch_up};
  std::vector<S> ended = held, early = held;
  ended.push_back(S::throttle_off);
  std::swap(early[2], early[4]);  // the throttle is pressed before the old gear is out
  std::swap(early[3], early[4]);
  for (std::vector<S> steps : {held, ended, early}) {
    CHECK(steps_out_of_place(steps, 3, 2) == 0);
    CHECK(steps_out_of_place(steps, 2, 3) > 0);  // for a shift to a higher gear, the throttle is pressed too early
  }
  CHECK(steps_out_of_place(std::span(held).first(5), 3, 2) == 1);
  ended.push_back(S::throttle_on);
  CHECK(steps_out_of_place(ended, 3, 2) == 0);
}

TEST_CASE("double declutching is accepted up and down, with a blip only on the way down") {
  const std::vector<S> twice{S::throttle_off, S::clutch_down, S::neutral,  S::clutch_up,
                             S::clutch_down,  S::gear,        S::clutch_up};
  std::vector<S> blip = twice;
  blip.insert(blip.begin() + 4, {S::throttle_on, S::throttle_off});
  CHECK(steps_out_of_place(twice, 3, 2) == 0);
  CHECK(steps_out_of_place(twice, 2, 3) == 0);
  CHECK(steps_out_of_place(blip, 3, 2) == 0);
  CHECK(steps_out_of_place(blip, 2, 3) == 2);
  CHECK(steps_out_of_place(twice, 2, kNeutralGear) == 3);
}

TEST_CASE("steps that are missing because a shift was cut short do not count") {
  const std::vector<S> all_steps = taught_steps(2, 3);
  for (std::size_t n = 0; n <= all_steps.size(); ++n) {
    CHECK(steps_out_of_place(std::span(all_steps).first(n), 2, 3, false) == 0);
  }
  CHECK(steps_out_of_place(std::vector<S>{S::gear, S::neutral}, 2, 3, false) == 2);
}

TEST_CASE("mistakes in the order of steps are named") {
  const auto slip = [](std::vector<S> steps) { return first_order_mistake(steps, 2, 3); };
  CHECK(slip(taught_steps(2, 3)) == OrderMistake::other);
  CHECK(slip({S::clutch_down, S::neutral, S::gear, S::clutch_up}) == OrderMistake::throttle_stayed);
  CHECK(slip({S::clutch_down, S::neutral, S::throttle_off, S::gear, S::clutch_up}) == OrderMistake::throttle_late);
  CHECK(slip({S::throttle_off, S::neutral, S::clutch_down, S::gear, S::clutch_up}) == OrderMistake::lever_first);
  CHECK(slip({S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::gear}) == OrderMistake::clutch_before_gear);
  CHECK(slip({S::throttle_off, S::clutch_down, S::neutral, S::gear, S::throttle_on, S::clutch_up}) ==
        OrderMistake::throttle_early);
}

TEST_CASE("a missing or additional step counts as one misplaced step, two swapped steps as two") {
  CHECK(steps_out_of_place(std::vector<S>{S::clutch_down, S::neutral, S::gear, S::clutch_up}, 2, 3) == 1);
  CHECK(steps_out_of_place(std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::gear}, 2, 3) ==
        2);
  CHECK(steps_out_of_place(std::vector<S>{}, 2, 3) == 5);
}
