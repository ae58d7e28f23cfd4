// A record's durations, put back on the clock.
#include "app/report/shift_times.h"

#include <doctest/doctest.h>

#include "app/report/chosen_shifts.h"
#include "tests/app/report/constructed_history.h"

using namespace gearshift;

TEST_CASE("clutch first: lever, gear and clutch follow by what the record says") {
  const ShiftTimes times = shift_times(good_shift(0, 7.0));
  CHECK(*times.clutch_down == 0.0);
  CHECK(*times.lever_left == doctest::Approx(0.1));
  CHECK(*times.gear_in == doctest::Approx(0.35));
  CHECK(*times.clutch_up == doctest::Approx(0.5));
  CHECK(*times.clutch_up - *times.clutch_down == doctest::Approx(0.5));  // the record's own clutch time
  CHECK(times.end == doctest::Approx(0.6));
}

TEST_CASE("lever first: the shift begins with it; the clutch up before the gear: its time is before the gear's") {
  ShiftRecord shift = good_shift(0, 7.0);
  shift.clutch_lead = -0.08;
  shift.clutch_lag = -0.05;
  const ShiftTimes times = shift_times(shift);
  CHECK(*times.lever_left == 0.0);
  CHECK(*times.clutch_down == doctest::Approx(0.08));
  CHECK(*times.gear_in == doctest::Approx(0.25));
  CHECK(*times.clutch_up == doctest::Approx(0.20));
}

TEST_CASE("without clutch, or without gear, there is no such time") {
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

TEST_CASE("chosen: at most three of each, graded runs alone, the worst by points, the best by time") {
  LearnerHistory history;
  for (int i = 0; i < 6; ++i) history.runs.push_back(run_with(i + 1, 2, 5.0));
  const auto spoil = [&](std::size_t run, double points) {
    LessonResult& result = history.runs[run].row.result;
    result.faults = {{FaultKind::grind, Severity::minor, 5.1, 1.0, 0}};
    result.deductions = {{0, points}};
  };
  spoil(0, 0.5);
  spoil(1, 4.0);
  spoil(2, 2.0);
  spoil(3, 2.0);
  spoil(4, 9.0);
  history.runs[4].row.result.guided = true;
  history.runs[5].row.result.shifts[1].end -= 0.1;
  history.runs[0].row.result.shifts[1].from = kNeutralGear;  // the quickest, but out of neutral
  history.runs[0].row.result.shifts[1].end -= 0.3;
  history.runs[5].row.result.shifts[0].missed = true;
  const ChosenShifts chosen = choose_shifts(history);
  REQUIRE(chosen.worst.size() == 3);
  CHECK(chosen.worst[0].run == 2);
  CHECK(chosen.worst[0].points == 4.0);
  CHECK(chosen.worst[0].faults.size() == 1);
  CHECK(chosen.worst[1].run == 4);  // of two alike the later
  CHECK(chosen.worst[2].run == 3);
  REQUIRE(chosen.best.size() == 3);
  CHECK(chosen.best[0].run == 6);
  CHECK(chosen.best[0].shift.number == 1);
  for (const ChosenShift& best : chosen.best) CHECK(best.run != 5);
  CHECK(choose_shifts({}).worst.empty());
}
