// How often an error happens, and whether it becomes rarer, compared with counts by hand.
#include "app/lessons/report/weak_spots.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "app/lessons/report/sections.h"
#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

Trend trend(std::vector<LessonHalves> lessons) {
  return trend_of(lessons);
}

}  // namespace

TEST_CASE("a trend is reported if it would occur by chance with a probability below one in twenty") {
  // n of 2n runs have the error, all in the same half. The probability of that by chance is 1/C(2n, n), with C = 6, 20,
  // 70 for n = 2, 3, 4.
  CHECK(trend({{3, 3, 0}}) == Trend::unclear);  // 1/20 is not below one in twenty
  CHECK(trend({{4, 4, 0}}) == Trend::falling);
  CHECK(trend({{4, 0, 4}}) == Trend::rising);
  // k of 40 runs have the error, all in the same half. The probability is 20/40 19/39 ... (k factors): 0.0530 for k =
  // 4, and 0.0236 for k = 5.
  CHECK(trend({{20, 4, 0}}) == Trend::unclear);
  CHECK(trend({{20, 5, 0}}) == Trend::falling);
  CHECK(trend({{20, 0, 5}}) == Trend::rising);
  // The trends of two such lessons are not significant separately; together they are, with a probability of (1/6)^2.
  CHECK(trend({{2, 2, 0}}) == Trend::unclear);
  CHECK(trend({{2, 2, 0}, {2, 2, 0}}) == Trend::falling);
  CHECK(trend({{2, 2, 0}, {2, 0, 2}}) == Trend::unclear);
  // There is no trend if all runs have the error, or none.
  CHECK(trend({{9, 9, 9}, {9, 0, 0}}) == Trend::unclear);
  CHECK(trend({}) == Trend::unknown);
  CHECK(trend({{1000, 700, 500}, {1000, 500, 500}}) == Trend::falling);  // large counts do not overflow
}

// Invariant: the order in which lessons were driven must not look like a change of the learner.
TEST_CASE("a lesson with an error in each run, followed by a lesson without that error, is no change") {
  LearnerHistory history;
  for (int i = 0; i < 24; ++i) {
    history.runs.push_back(run_with(i + 1, 2, 5.0));
    LessonResult& result = history.runs.back().row.result;
    result.lesson = i < 12 ? "hill_start" : "skip_shifts";
    result.errors = {{i < 12 ? ErrorKind::stall : ErrorKind::rev_mismatch, Severity::severe, 0.0, 1.0, 0}};
  }
  for (const WeakSpot& spot : weaknesses(history).spots) {
    CHECK(spot.trend == Trend::unclear);
    CHECK(spot.earlier == 5.0);
    CHECK(spot.recent == 5.0);
  }
  // Control: stalls that stop during the lesson's runs are a change. Notes are not counted.
  for (std::size_t i = 6; i < 12; ++i) history.runs[i].row.result.errors[0].severity = Severity::note;
  const Weaknesses found = weaknesses(history);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& stall = found.spots[0].kind == ErrorKind::stall ? found.spots[0] : found.spots[1];
  CHECK(stall.trend == Trend::falling);
  CHECK(stall.per_ten == 10.0 * 6 / 48);
}

TEST_CASE("errors are counted by kind and severity, per ten shifts, earlier and recent") {
  LearnerHistory history;
  for (int i = 0; i < 4; ++i) history.runs.push_back(run_with(i + 1, 5, 8.0));
  const auto error = [&](std::size_t run, ErrorKind kind, Severity severity, double points) {
    LessonResult& result = history.runs[run].row.result;
    if (points > 0.0) result.deductions.push_back({result.errors.size(), points});
    result.errors.push_back({kind, severity, 0.0, 1.0, 0});
  };
  error(0, ErrorKind::stall, Severity::severe, 2.0);
  error(0, ErrorKind::grind, Severity::minor, 0.5);
  error(1, ErrorKind::grind, Severity::note, 0.0);
  error(3, ErrorKind::grind, Severity::very_severe, 4.0);
  history.runs.push_back(run_with(5, 7, 0.0));  // guided: neither its shifts nor its errors count
  history.runs.back().row.result.guided = true;
  error(4, ErrorKind::stall, Severity::severe, 0.0);

  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 20);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& grind = found.spots[0];
  CHECK(grind.kind == ErrorKind::grind);
  CHECK(grind.by_severity == std::array<std::size_t, 4>{1, 1, 0, 1});
  CHECK(grind.count == 3);
  CHECK(grind.points == 4.5);
  CHECK(grind.per_ten == 1.0);  // per ten shifts; the note does not count
  CHECK(grind.earlier == 5.0);  // per ten runs: in one of two runs
  CHECK(grind.recent == 5.0);
  const WeakSpot& stall = found.spots[1];
  CHECK(stall.count == 1);
  CHECK(stall.points == 2.0);
  CHECK(stall.recent == 0.0);
}

TEST_CASE("errors of runs in neither half are not compared: they must not be shown as 0 times before and after") {
  LearnerHistory history;
  for (int i = 0; i < 3; ++i) history.runs.push_back(run_with(i + 1, 2, 5.0));
  history.runs[1].row.result.errors = {{ErrorKind::stall, Severity::severe, 0.0, 1.0, 0}};
  REQUIRE(weaknesses(history).spots.size() == 1);
  CHECK(weaknesses(history).spots[0].trend == Trend::unknown);
  CHECK(weakness_section(history).find("0.0<br>") == std::string::npos);
  // Control: an error in the last run is compared.
  history.runs[2].row.result.errors = history.runs[1].row.result.errors;
  CHECK(weaknesses(history).spots[0].trend == Trend::unclear);
  CHECK(weakness_section(history).find("0.0<br>") != std::string::npos);
}

TEST_CASE("without runs there are no weaknesses; without shifts an error has no rate") {
  CHECK(weaknesses({}).spots.empty());
  LearnerHistory history;
  history.runs.push_back(run_with(1, 0, 6.0));
  history.runs[0].row.result.errors.push_back({ErrorKind::stall, Severity::severe, 0.0, 1.0, -1});
  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 0);
  REQUIRE(found.spots.size() == 1);
  CHECK(found.spots[0].per_ten == 0.0);
  CHECK(found.spots[0].trend == Trend::unknown);
}
