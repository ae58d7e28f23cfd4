// Which shifts are worth looking at.
#include "app/report/chosen_shifts.h"

#include <doctest/doctest.h>

#include "tests/app/report/constructed_history.h"

using namespace gearshift;

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
