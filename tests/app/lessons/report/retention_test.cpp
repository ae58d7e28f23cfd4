// Tests which runs show how much a learner retained. They are selected only by their times.
#include "app/lessons/report/retention.h"

#include <utility>

#include <doctest/doctest.h>

#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

ReportedRun run_at(std::int64_t id, std::string begun_at, double grade, std::string lesson = "drill") {
  ReportedRun run = run_with(id, 1, grade);
  run.row.begun_at = std::move(begun_at);
  run.row.result.lesson = std::move(lesson);
  return run;
}

}  // namespace

TEST_CASE("per lesson, each first graded run at least 20 h after the previous run, exact to the second") {
  LearnerHistory history;
  history.runs = {run_at(1, "2026-03-01T10:00:00Z", 5.0),
                  run_at(2, "2026-03-01T10:10:00Z", 6.0),
                  run_at(3, "2026-03-02T06:09:59Z", 6.5),             // 19 h 59 min 59 s after run 2
                  run_at(4, "2026-03-02T07:00:00Z", 3.0, "reverse"),  // the first run of this lesson
                  run_at(5, "2026-03-03T02:09:59Z", 7.0),             // 20 h after run 3
                  run_at(6, "2026-03-03T02:30:00Z", 8.0),             // 20 min after run 5
                  run_at(7, "2026-03-10T12:00:00Z", 7.5),
                  run_at(8, "2026-03-10T12:10:00Z", 4.0, "reverse")};
  const auto trials = retention_trials(history);
  REQUIRE(trials.size() == 3);
  CHECK(trials[0].run == 5);
  CHECK(trials[0].pause == 20 * 3600.0);
  CHECK(trials[0].grade == 7.0);
  CHECK(trials[0].before->run == 3);
  CHECK(trials[0].before->grade == 6.5);
  CHECK(trials[1].run == 7);
  CHECK(trials[1].before->grade == 8.0);
  CHECK(trials[1].pause > kWeekAfter);
  CHECK(trials[2].run == 8);
  CHECK(trials[2].lesson == "reverse");
  CHECK(trials[2].before->grade == 3.0);
}

TEST_CASE("a run after a guided run shows no retention; unfinished and left runs do not count as runs") {
  LearnerHistory history;
  history.runs = {run_at(1, "2026-03-01T10:00:00Z", 5.0), run_at(2, "2026-03-03T10:00:00Z", 0.0),
                  run_at(3, "2026-03-03T10:10:00Z", 6.0), run_at(4, "2026-03-05T10:00:00Z", 0.0),
                  run_at(5, "2026-03-05T10:10:00Z", 7.0)};
  history.runs[1].row.result.guided = true;
  for (const LessonEnd end : {LessonEnd::running, LessonEnd::left}) {
    history.runs[3].row.result.end = end;
    const auto trials = retention_trials(history);
    REQUIRE(trials.size() == 1);
    CHECK(trials[0].run == 5);
    CHECK(trials[0].before->run == 3);
  }
}

TEST_CASE("after guided runs only there is a break without a comparison; unreadable dates make no break") {
  LearnerHistory history;
  history.runs = {run_at(1, "2026-03-01T10:00:00Z", 0.0), run_at(2, "2026-03-02T10:00:00Z", 6.0),
                  run_at(3, "<yesterday>", 6.0), run_at(4, "2026-03-09T10:00:00Z", 6.0)};
  history.runs[0].row.result.guided = true;
  const auto trials = retention_trials(history);
  REQUIRE(trials.size() == 1);
  CHECK(trials[0].run == 2);
  CHECK_FALSE(trials[0].before);
  CHECK(retention_trials({}).empty());
}

TEST_CASE("the length of a break is written in hours or days") {
  CHECK(format_pause(20.0 * 3600.0) == "20 hours");
  CHECK(format_pause(47.4 * 3600.0) == "47 hours");
  CHECK(format_pause(7.2 * 86400.0) == "7 days");
}
