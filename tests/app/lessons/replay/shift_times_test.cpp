// The durations in a shift record, converted to times from the shift's begin.
#include "app/lessons/replay/shift_times.h"

#include <doctest/doctest.h>

#include "tests/app/lessons/replay/constructed_record.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("clutch first: the times of lever, gear and clutch follow from the record") {
  const ShiftTimes times = shift_times(good_shift(0, 7.0));
  CHECK(*times.clutch_down == 0.0);
  CHECK(*times.lever_left == doctest::Approx(0.1));
  CHECK(*times.gear_in == doctest::Approx(0.35));
  CHECK(*times.clutch_up == doctest::Approx(0.5));
  CHECK(*times.clutch_up - *times.clutch_down == doctest::Approx(0.5));  // the record's clutch_time
  CHECK(times.end == doctest::Approx(0.6));
}

TEST_CASE(
    "lever first: the shift begins with the lever; a clutch that comes up before the gear is in has the earlier time") {
  ShiftRecord shift = good_shift(0, 7.0);
  shift.clutch_lead = -0.08;
  shift.clutch_lag = -0.05;
  const ShiftTimes times = shift_times(shift);
  CHECK(*times.lever_left == 0.0);
  CHECK(*times.clutch_down == doctest::Approx(0.08));
  CHECK(*times.gear_in == doctest::Approx(0.25));
  CHECK(*times.clutch_up == doctest::Approx(0.20));
}

TEST_CASE("clutch pressed twice: only the time of the first press is known, and no time of a release") {
  ShiftRecord twice = good_shift(0, 7.0);
  twice.steps = {ShiftStep::clutch_down, ShiftStep::neutral,   ShiftStep::clutch_up,
                 ShiftStep::clutch_down, ShiftStep::clutch_up, ShiftStep::gear};
  CHECK(shift_times(twice).presses == 2);
  CHECK(*shift_times(twice).clutch_down == 0.0);
  CHECK_FALSE(shift_times(twice).clutch_up.has_value());
  CHECK(*shift_times(twice).gear_in == doctest::Approx(0.35));
  CHECK(shift_times(good_shift(0, 7.0)).presses == 1);
}

TEST_CASE("the time of a clutch or gear that was not used is missing") {
  ShiftRecord no_clutch = good_shift(0, 7.0);
  no_clutch.steps = {ShiftStep::neutral, ShiftStep::gear};
  no_clutch.clutch_time = no_clutch.clutch_lead = no_clutch.clutch_lag = 0.0;
  CHECK_FALSE(shift_times(no_clutch).clutch_down.has_value());
  CHECK(*shift_times(no_clutch).gear_in == doctest::Approx(0.25));

  ShiftRecord no_gear = good_shift(0, 7.0);
  no_gear.to = kNeutralGear;
  no_gear.steps = {ShiftStep::clutch_down, ShiftStep::neutral, ShiftStep::clutch_up};
  no_gear.lever_time = no_gear.clutch_lag = 0.0;
  CHECK_FALSE(shift_times(no_gear).gear_in.has_value());
  CHECK(*shift_times(no_gear).clutch_up == doctest::Approx(0.5));
}
