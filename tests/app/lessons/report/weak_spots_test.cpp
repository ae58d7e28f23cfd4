// Tests how often an error happens and whether it becomes rarer, against counts made by hand.
#include "app/lessons/report/weak_spots.h"

#include <cmath>
#include <random>
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
  // The error occurs in n of 2n runs, all in one half. The probability that chance puts all n into this half is 1/C(2n,
  // n), where C(2n, n) = 6, 20, 70 for n = 2, 3, 4.
  CHECK(trend({{3, 3, 0}}) == Trend::unclear);  // 1/20 is not below one in twenty
  CHECK(trend({{4, 4, 0}}) == Trend::falling);
  CHECK(trend({{4, 0, 4}}) == Trend::rising);
  // The error occurs in k of 40 runs, all in one half. The probability that chance puts all k into this half is the
  // product of the k factors 20/40, 19/39, ...: 0.0530 for k = 4, and 0.0236 for k = 5.
  CHECK(trend({{20, 4, 0}}) == Trend::unclear);
  CHECK(trend({{20, 5, 0}}) == Trend::falling);
  CHECK(trend({{20, 0, 5}}) == Trend::rising);
  // If one lesson has 4 runs, and 2 in the same half have the error, the probability is 1/C(4, 2) = 1/6, which is not
  // significant. For two such lessons together it is (1/6)^2, which is significant.
  CHECK(trend({{2, 2, 0}}) == Trend::unclear);
  CHECK(trend({{2, 2, 0}, {2, 2, 0}}) == Trend::falling);
  CHECK(trend({{2, 2, 0}, {2, 0, 2}}) == Trend::unclear);
  // There is no trend if all runs have the error, or if no run has it.
  CHECK(trend({{9, 9, 9}, {9, 0, 0}}) == Trend::unclear);
  CHECK(trend({}) == Trend::unknown);
  CHECK(trend({{1000, 700, 500}, {1000, 500, 500}}) == Trend::falling);  // large counts do not overflow
}

// Invariant: the order in which lessons were driven must not look like a change in the learner's skill.
TEST_CASE("a lesson with an error in each run, followed by a lesson without that error, is no change") {
  LearnerHistory history;
  for (int i = 0; i < 24; ++i) {
    history.runs.push_back(run_with(i + 1, 2, 5.0));
    LessonResult& result = history.runs.back().result;
    result.lesson = i < 12 ? "hill_start" : "skip_shifts";
    result.errors = {
        make_driving_error(i < 12 ? ErrorKind::stall : ErrorKind::rev_mismatch, Severity::severe, 0.0, 1.0, 0)};
  }
  for (const WeakSpot& spot : weaknesses(history).spots) {
    CHECK(spot.trend == Trend::unclear);
    CHECK(spot.earlier == 5.0);
    CHECK(spot.recent == 5.0);
  }
  // Control: if stalls stop in the middle of the lesson's runs, that is a change. Notes do not count as stalls.
  for (std::size_t i = 6; i < 12; ++i) history.runs[i].result.errors[0].severity = Severity::note;
  const Weaknesses found = weaknesses(history);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& stall = found.spots[0].kind == ErrorKind::stall ? found.spots[0] : found.spots[1];
  CHECK(stall.trend == Trend::gone);
  CHECK(stall.per_ten == 10.0 * 6 / 48);
}

TEST_CASE("errors are counted by kind and severity, per ten shifts, earlier and recent") {
  LearnerHistory history;
  for (int i = 0; i < 4; ++i) history.runs.push_back(run_with(i + 1, 5, 8.0));
  const auto error = [&](std::size_t run, ErrorKind kind, Severity severity, double points) {
    LessonResult& result = history.runs[run].result;
    result.errors.push_back(make_driving_error(kind, severity, 0.0, 1.0, 0));
    result.errors.back().points = points;
  };
  error(0, ErrorKind::stall, Severity::severe, 2.0);
  error(0, ErrorKind::grind, Severity::minor, 0.5);
  error(1, ErrorKind::grind, Severity::note, 0.0);
  error(3, ErrorKind::grind, Severity::very_severe, 4.0);
  history.runs.push_back(run_with(5, 10, 0.0));  // a guided run: its shifts and errors count, its points do not
  history.runs.back().result.guided = true;
  error(4, ErrorKind::stall, Severity::severe, 2.0);

  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 30);
  REQUIRE(found.spots.size() == 2);
  const WeakSpot& grind = found.spots[0];
  CHECK(grind.kind == ErrorKind::grind);
  CHECK(grind.by_severity == std::array<std::size_t, 4>{1, 1, 0, 1});
  CHECK(grind.count == 3);
  CHECK(grind.points == 4.5);
  CHECK(grind.per_ten == 20.0 / 30.0);  // two errors in 30 shifts; the note does not count
  CHECK(grind.graded == 2);
  CHECK(grind.clean == 0);
  CHECK(grind.earlier == 5.0);  // one of the two earlier runs had the error; the rate is per ten runs
  CHECK(grind.recent == 5.0);
  const WeakSpot& stall = found.spots[1];
  CHECK(stall.count == 2);
  CHECK(stall.points == 2.0);
  CHECK(stall.graded == 1);
  CHECK(stall.clean == 3);
  CHECK(stall.recent == 0.0);
}

TEST_CASE("errors of runs in neither half are not compared: they must not be shown as 0 times before and after") {
  LearnerHistory history;
  for (int i = 0; i < 3; ++i) history.runs.push_back(run_with(i + 1, 2, 5.0));
  history.runs[1].result.errors = {make_driving_error(ErrorKind::stall, Severity::severe, 0.0, 1.0, 0)};
  REQUIRE(weaknesses(history).spots.size() == 1);
  CHECK(weaknesses(history).spots[0].trend == Trend::unknown);
  CHECK(weakness_section(history).find("0.0<br>") == std::string::npos);
  // Control: of three runs only the middle one is in neither half. So if the last run has the error, the halves are
  // compared.
  history.runs[2].result.errors = history.runs[1].result.errors;
  CHECK(weaknesses(history).spots[0].trend == Trend::unclear);
  CHECK(weakness_section(history).find("0.0<br>") != std::string::npos);
}

// Laplace's rule of succession: after n runs that all had the error, k runs without it have the chance 1/C(n + k + 1, k).
TEST_CASE("the chance of runs without an error, if nothing has changed") {
  CHECK(clean_run_chance(1, 1, 1) == doctest::Approx(1.0 / 3.0));   // C(3, 1) = 3
  CHECK(clean_run_chance(2, 2, 4) == doctest::Approx(1.0 / 35.0));  // C(7, 4) = 35
  CHECK(clean_run_chance(8, 8, 2) == doctest::Approx(1.0 / 55.0));  // C(11, 2) = 55
  CHECK(clean_run_chance(1, 2, 1) == doctest::Approx(1.0 / 2.0));   // (2 - 1 + 1) / (2 + 2)
  CHECK(clean_run_chance(3, 9, 0) == 1.0);
}

TEST_CASE("an error is not gone while the latest run of one of its lessons still has it") {
  LearnerHistory history;
  const auto drive = [&](const char* lesson, bool stalls) {
    history.runs.push_back(run_with(static_cast<std::int64_t>(history.runs.size()) + 1, 0, 6.0));
    LessonResult& result = history.runs.back().result;
    result.lesson = lesson;
    if (stalls) result.errors = {make_driving_error(ErrorKind::stall, Severity::severe, 0.0, 1.0, -1)};
  };
  drive("start", true);
  for (int i = 0; i < 3; ++i) drive("hill_start", true);
  for (int i = 0; i < 8; ++i) drive("start", false);
  CHECK(weaknesses(history).spots[0].trend != Trend::gone);
  CHECK(weaknesses(history).spots[0].clean == 0);
  for (int i = 0; i < 2; ++i) drive("hill_start", false);
  CHECK(weaknesses(history).spots[0].trend == Trend::gone);
  CHECK(weaknesses(history).spots[0].clean == 10);
}

// Control: histories in which every run has the error with the same probability. The share of those called gone must
// stay what weak_spots.h states.
TEST_CASE("in histories without any change, at most 12 % of the errors are called gone") {
  std::mt19937 random(7);
  for (const int runs : {6, 10, 20, 40}) {
    for (const double rate : {0.05, 0.1, 0.3, 0.5, 0.9}) {
      int gone = 0;
      constexpr int kHistories = 400;
      for (int n = 0; n < kHistories; ++n) {
        LearnerHistory history;
        for (int i = 0; i < runs; ++i) {
          history.runs.push_back(run_with(i + 1, 0, 6.0));
          if (std::bernoulli_distribution(rate)(random))
            history.runs.back().result.errors = {make_driving_error(ErrorKind::stall, Severity::severe, 0.0, 1.0, -1)};
        }
        const Weaknesses found = weaknesses(history);
        gone += !found.spots.empty() && found.spots[0].trend == Trend::gone ? 1 : 0;
      }
      CAPTURE(runs);
      CAPTURE(rate);
      CHECK(gone <= 0.12 * kHistories + 3.0 * std::sqrt(0.12 * 0.88 * kHistories));  // and three standard deviations
    }
  }
}

TEST_CASE("without runs there are no weaknesses; without shifts an error has no rate") {
  CHECK(weaknesses({}).spots.empty());
  LearnerHistory history;
  history.runs.push_back(run_with(1, 0, 6.0));
  history.runs[0].result.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 0.0, 1.0, -1));
  const Weaknesses found = weaknesses(history);
  CHECK(found.shifts == 0);
  REQUIRE(found.spots.size() == 1);
  CHECK(found.spots[0].per_ten == 0.0);
  CHECK(found.spots[0].trend == Trend::unknown);
}
