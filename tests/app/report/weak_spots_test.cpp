// How often a fault happens, and whether it becomes less: counted by hand.
#include "app/report/weak_spots.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "app/report/sections.h"
#include "tests/app/report/constructed_history.h"

using namespace gearshift;

namespace {

Trend trend(std::vector<LessonHalves> lessons) {
  return trend_of(lessons);
}

}  // namespace

TEST_CASE("a change is told where chance alone would give it less than one time in twenty") {
  // Of 2n runs n have it, all of them in one half: one way in C(2n, n), which is 6, 20, 70 for n = 2, 3, 4.
  CHECK(trend({{3, 3, 0}}) == Trend::unclear);  // 1/20 is not rare
  CHECK(trend({{4, 4, 0}}) == Trend::falling);
  CHECK(trend({{4, 0, 4}}) == Trend::rising);
  // Of 40 runs k have it, all of them in one half: 20/40 19/39 ... k factors; 0.0530 for 4, 0.0236 for 5.
  CHECK(trend({{20, 4, 0}}) == Trend::unclear);
  CHECK(trend({{20, 5, 0}}) == Trend::falling);
  CHECK(trend({{20, 0, 5}}) == Trend::rising);
  // Two lessons by themselves say nothing, together (1/6)^2.
  CHECK(trend({{2, 2, 0}}) == Trend::unclear);
  CHECK(trend({{2, 2, 0}, {2, 2, 0}}) == Trend::falling);
  CHECK(trend({{2, 2, 0}, {2, 0, 2}}) == Trend::unclear);
  // In all runs, or in none, there is nothing to learn.
  CHECK(trend({{9, 9, 9}, {9, 0, 0}}) == Trend::unclear);
  CHECK(trend({}) == Trend::unknown);
  CHECK(trend({{1000, 700, 500}, {1000, 500, 500}}) == Trend::falling);  // no overflow
}

// Law: which lessons were driven when is no change of the learner.
TEST_CASE("a lesson with a fault in each of its runs, and another one without it later: nothing has changed") {
  LearnerHistory history;
  for (int i = 0; i < 24; ++i) {
    history.runs.push_back(run_with(i + 1, 2, 5.0));
    LessonResult& result = history.runs.back().row.result;
    result.lesson = i < 12 ? "hill_start" : "skip_shifts";
    result.faults = {{i < 12 ? FaultKind::stall : FaultKind::rev_mismatch, Severity::severe, 0.0, 1.0, 0}};
  }
  for (const WeakSpot& spot : weaknesses(history).spots) {
    CHECK(spot.trend == Trend::unclear);
    CHECK(spot.earlier == 5.0);
    CHECK(spot.lately == 5.0);
  }
  // Control: stalls that end within the lesson are a change; notes that come are none.
  for (std::size_t i = 6; i < 12; ++i) history.runs[i].row.result.faults[0].severity = Severity::note;
  const Weaknesses found = weaknesses(history);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& stall = found.spots[0].kind == FaultKind::stall ? found.spots[0] : found.spots[1];
  CHECK(stall.trend == Trend::falling);
  CHECK(stall.per_ten == 10.0 * 6 / 48);
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
  CHECK(grind.per_ten == 1.0);  // the note is none
  CHECK(grind.earlier == 5.0);  // one of two runs
  CHECK(grind.lately == 5.0);
  const WeakSpot& stall = found.spots[1];
  CHECK(stall.count == 1);
  CHECK(stall.points == 2.0);
  CHECK(stall.lately == 0.0);
}

TEST_CASE("a fault of runs that stand in no half is not compared: it was not seen 0 times before and after") {
  LearnerHistory history;
  for (int i = 0; i < 3; ++i) history.runs.push_back(run_with(i + 1, 2, 5.0));
  history.runs[1].row.result.faults = {{FaultKind::stall, Severity::severe, 0.0, 1.0, 0}};
  REQUIRE(weaknesses(history).spots.size() == 1);
  CHECK(weaknesses(history).spots[0].trend == Trend::unknown);
  CHECK(weakness_section(history).find("0.0<br>") == std::string::npos);
  // Control: the same in the last run is compared.
  history.runs[2].row.result.faults = history.runs[1].row.result.faults;
  CHECK(weaknesses(history).spots[0].trend == Trend::unclear);
  CHECK(weakness_section(history).find("0.0<br>") != std::string::npos);
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
