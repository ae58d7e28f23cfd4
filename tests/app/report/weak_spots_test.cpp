// How often a fault happens, and whether it becomes less: counted by hand.
#include "app/report/weak_spots.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/app/report/constructed_history.h"

using namespace gearshift;

TEST_CASE("a change is told where chance alone would give it less than one time in twenty") {
  // Equal halves: of n faults all in one half has the chance 2^-n. 1/16 is not rare, 1/32 is.
  CHECK(trend_of(4, 20, 0, 20) == Trend::unclear);
  CHECK(trend_of(5, 20, 0, 20) == Trend::falling);
  CHECK(trend_of(0, 20, 4, 20) == Trend::unclear);
  CHECK(trend_of(0, 20, 5, 20) == Trend::rising);
  // A later part of 90 % of the shifts: all of n there has the chance 0.9^n, none of them 0.1^n.
  CHECK(trend_of(0, 10, 28, 90) == Trend::unclear);
  CHECK(trend_of(0, 10, 29, 90) == Trend::rising);  // 0.9^28 = 0.0523, 0.9^29 = 0.0471
  CHECK(trend_of(1, 10, 0, 90) == Trend::unclear);
  CHECK(trend_of(2, 10, 0, 90) == Trend::falling);
  CHECK(trend_of(0, 20, 0, 20) == Trend::unclear);
  CHECK(trend_of(3, 0, 3, 20) == Trend::unknown);
  CHECK(trend_of(3, 20, 0, 0) == Trend::unknown);
  CHECK(trend_of(5000, 1000, 5000, 1000) == Trend::unclear);  // no overflow
}

TEST_CASE("faults are counted by kind and severity, per ten shifts, earlier and lately") {
  LearnerHistory history;
  for (int i = 0; i < 4; ++i) history.runs.push_back(run_with(i + 1, 5, 8.0));
  const auto fault = [&](std::size_t run, FaultKind kind, Severity severity, double points) {
    LessonResult& result = history.runs[run].row.result;
    if (points > 0.0) result.deductions.push_back({result.faults.size(), points});
    result.faults.push_back({kind, severity, 0.0, 1.0, 0});
  };
  fault(0, FaultKind::stall, Severity::severe, 2.0);
  fault(0, FaultKind::grind, Severity::minor, 0.5);
  fault(1, FaultKind::grind, Severity::note, 0.0);
  fault(3, FaultKind::grind, Severity::very_severe, 4.0);
  history.runs.push_back(run_with(5, 7, 0.0));  // guided: neither its shifts nor its faults
  history.runs.back().row.result.guided = true;
  fault(4, FaultKind::stall, Severity::severe, 0.0);

  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 20);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& grind = found.spots[0];
  CHECK(grind.kind == FaultKind::grind);
  CHECK(grind.by_severity == std::array<std::size_t, 4>{1, 1, 0, 1});
  CHECK(grind.count == 3);
  CHECK(grind.points == 4.5);
  CHECK(grind.per_ten == 1.5);
  CHECK(grind.earlier == 2.0);  // 2 in 10 shifts
  CHECK(grind.lately == 1.0);
  const WeakSpot& stall = found.spots[1];
  CHECK(stall.count == 1);
  CHECK(stall.points == 2.0);
  CHECK(stall.lately == 0.0);
}

TEST_CASE("no runs, no weaknesses; runs without shifts have no rate") {
  CHECK(weaknesses({}).spots.empty());
  LearnerHistory history;
  history.runs.push_back(run_with(1, 0, 6.0));
  history.runs[0].row.result.faults.push_back({FaultKind::stall, Severity::severe, 0.0, 1.0, -1});
  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 0);
  REQUIRE(found.spots.size() == 1);
  CHECK(found.spots[0].per_ten == 0.0);
  CHECK(found.spots[0].trend == Trend::unknown);
}
