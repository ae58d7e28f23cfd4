// Tests which shifts the report shows in detail.
#include "app/lessons/report/chosen_shifts.h"

#include <functional>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("at most three worst (by points) and three best (by time) shifts, from graded runs only") {
  LearnerHistory history;
  for (int i = 0; i < 6; ++i) history.runs.push_back(run_with(i + 1, 2, 5.0));
  const auto spoil = [&](std::size_t run, double points) {
    LessonResult& result = history.runs[run].result;
    result.errors = {make_driving_error(ErrorKind::grind, Severity::minor, 5.1, 1.0, 0)};
    result.errors[0].points = points;
  };
  spoil(0, 0.5);
  spoil(1, 4.0);
  spoil(2, 2.0);
  spoil(3, 2.0);
  spoil(4, 9.0);
  history.runs[4].result.guided = true;
  history.runs[5].result.shifts[1].end -= 0.1;
  history.runs[0].result.shifts[1].from = kNeutralGear;  // the quickest shift, but it starts in neutral
  history.runs[0].result.shifts[1].end -= 0.3;
  history.runs[5].result.shifts[0].missed = true;
  const ChosenShifts chosen = choose_shifts(history);
  REQUIRE(chosen.worst.size() == 3);
  CHECK(chosen.worst[0].run == 2);
  CHECK(chosen.worst[0].points == 4.0);
  CHECK(chosen.worst[0].errors.size() == 1);
  CHECK(chosen.worst[1].run == 4);  // of two shifts that cost equal points, the later comes first
  CHECK(chosen.worst[2].run == 3);
  REQUIRE(chosen.best.size() == 3);
  CHECK(chosen.best[0].run == 6);
  CHECK(chosen.best[0].shift.number == 1);
  for (const ChosenShift& best : chosen.best) CHECK(best.run != 5);
  CHECK(choose_shifts({}).worst.empty());
}

TEST_CASE("the best shifts are the quickest without an error, even in a run that lost points") {
  using Spoil = std::function<void(LessonResult&)>;
  const auto error = [](ErrorKind kind, Severity severity) {
    return [=](LessonResult& result) { result.errors = {make_driving_error(kind, severity, 5.2, 1.0, 0)}; };
  };
  const std::vector<std::pair<const char*, Spoil>> wrong{
      {"a step out of place", [](LessonResult& r) { r.shifts[0].steps_out_of_place = 1; }},
      {"clutch up before the gear was in", [](LessonResult& r) { r.shifts[0].clutch_lag = -0.01; }},
      {"lever before the clutch", [](LessonResult& r) { r.shifts[0].clutch_lead = -0.01; }},
      {"a block", [](LessonResult& r) { r.shifts[0].block_time = 1.2; }},
      {"a grind", [](LessonResult& r) { r.shifts[0].grind_time = 0.001; }},
      {"a wrong slot", [](LessonResult& r) { r.shifts[0].wrong_columns = 1; }},
      {"a fault that cost nothing", error(ErrorKind::over_push, Severity::minor)},
      {"a note", error(ErrorKind::jerk, Severity::note)},
  };
  for (const auto& each : wrong) {
    CAPTURE(each.first);
    LearnerHistory history;
    history.runs = {run_with(1, 1, 10.0), run_with(2, 1, 10.0)};
    LessonResult& quick = history.runs[1].result;
    quick.shifts[0].end -= 0.2;
    quick.shifts[0].block_time = 0.3;  // normal synchronising time is not a block
    REQUIRE(choose_shifts(history).best.size() == 2);
    CHECK(choose_shifts(history).best[0].run == 2);
    each.second(quick);
    const ChosenShifts chosen = choose_shifts(history);
    REQUIRE(chosen.best.size() == 1);
    CHECK(chosen.best[0].run == 1);
  }
}
