// Order of pedals and lever: the edit distance on words that everybody knows, and on shifts.
#include "app/training/step_order.h"

#include <doctest/doctest.h>

using namespace gearshift;
using S = ShiftStep;

TEST_CASE("the taught order leaves out what there is nothing to do for") {
  CHECK(taught_steps(2, 3) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::gear, S::clutch_up, S::throttle_on});
  CHECK(taught_steps(kNeutralGear, 1) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::gear, S::clutch_up, S::throttle_on});
  CHECK(taught_steps(1, kNeutralGear) ==
        std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::throttle_on});
}

TEST_CASE("what is done as taught is in place, with or without the throttle after it") {
  const std::vector<S> whole = taught_steps(2, 3);
  CHECK(steps_out_of_place(whole, 2, 3) == 0);
  CHECK(steps_out_of_place(std::span(whole).first(5), 2, 3) == 0);
}

TEST_CASE("one step left out or too many counts one, two exchanged count two") {
  CHECK(steps_out_of_place(std::vector<S>{S::clutch_down, S::neutral, S::gear, S::clutch_up}, 2, 3) == 1);
  CHECK(steps_out_of_place(std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::gear}, 2, 3) ==
        2);
  // Double clutch: up and down again in neutral.
  CHECK(steps_out_of_place(std::vector<S>{S::throttle_off, S::clutch_down, S::neutral, S::clutch_up, S::clutch_down,
                                          S::gear, S::clutch_up},
                           3, 2) == 2);
  CHECK(steps_out_of_place(std::vector<S>{}, 2, 3) == 5);
}
