// Tests which runs are graded trials, and which of them come after a break. Breaks depend only on the runs' times.
#include "app/lessons/history/graded_trials.h"

#include <utility>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

RunRow run_at(std::int64_t id, std::string begun_at, double grade, std::string lesson = "drill") {
  RunRow run;
  run.id = id;
  run.begun_at = std::move(begun_at);
  run.result.lesson = std::move(lesson);
  run.result.end = LessonEnd::done;
  run.result.grade = grade;
  return run;
}

std::vector<GradedTrial> after_breaks(const std::vector<RunRow>& runs) {
  std::vector<GradedTrial> trials = graded_trials(runs);
  std::erase_if(trials, [](const GradedTrial& trial) { return trial.pause == 0.0; });
  return trials;
}

}  // namespace

TEST_CASE("graded trials are the runs that ended, unguided and complete") {
  std::vector<RunRow> runs;
  for (int i = 0; i < 7; ++i) runs.push_back(run_at(i, "2026-03-01T10:00:00Z", 5.0));
  runs[0].result.end = LessonEnd::running;
  runs[1].result.end = LessonEnd::left;
  runs[2].result.end = LessonEnd::aborted;
  runs[3].result.end = LessonEnd::out_of_time;
  runs[4].result.guided = true;
  runs[5].result.is_complete = false;
  runs[6].result.passed = true;
  runs[6].result.task = "upshift";
  const std::vector<GradedTrial> trials = graded_trials(runs);
  REQUIRE(trials.size() == 3);
  CHECK(trials[0].run == 2);
  CHECK(trials[1].run == 3);
  CHECK(trials[2].run == 6);
  CHECK(trials[2].task == "upshift");
  CHECK(trials[2].passed);
  CHECK(trials[2].begun_at == "2026-03-01T10:00:00Z");
}

TEST_CASE("per lesson, each first graded run at least 20 h after the previous run, exact to the second") {
  const std::vector<RunRow> runs{run_at(1, "2026-03-01T10:00:00Z", 5.0),
                                 run_at(2, "2026-03-01T10:10:00Z", 6.0),
                                 run_at(3, "2026-03-02T06:09:59Z", 6.5),             // 19 h 59 min 59 s after run 2
                                 run_at(4, "2026-03-02T07:00:00Z", 3.0, "reverse"),  // the first run of this lesson
                                 run_at(5, "2026-03-03T02:09:59Z", 7.0),             // 20 h after run 3
                                 run_at(6, "2026-03-03T02:30:00Z", 8.0),             // 20 min after run 5
                                 run_at(7, "2026-03-10T12:00:00Z", 7.5),
                                 run_at(8, "2026-03-10T12:10:00Z", 4.0, "reverse")};
  const auto trials = after_breaks(runs);
  REQUIRE(trials.size() == 3);
  CHECK(trials[0].run == 5);
  CHECK(trials[0].pause == 20 * 3600.0);
  CHECK(trials[0].grade == 7.0);
  CHECK(trials[1].run == 7);
  CHECK(trials[1].pause > 6.0 * 24.0 * 3600.0);
  CHECK(trials[2].run == 8);
  CHECK(trials[2].lesson == "reverse");
}

TEST_CASE("a run after a guided run comes after no break; unfinished and left runs do not count as runs") {
  std::vector<RunRow> runs{run_at(1, "2026-03-01T10:00:00Z", 5.0), run_at(2, "2026-03-03T10:00:00Z", 0.0),
                           run_at(3, "2026-03-03T10:10:00Z", 6.0), run_at(4, "2026-03-05T10:00:00Z", 0.0),
                           run_at(5, "2026-03-05T10:10:00Z", 7.0)};
  runs[1].result.guided = true;
  for (const LessonEnd end : {LessonEnd::running, LessonEnd::left}) {
    runs[3].result.end = end;
    const auto trials = after_breaks(runs);
    REQUIRE(trials.size() == 1);
    CHECK(trials[0].run == 5);
  }
}

TEST_CASE("a guided run before a break counts; unreadable dates make no break") {
  std::vector<RunRow> runs{run_at(1, "2026-03-01T10:00:00Z", 0.0), run_at(2, "2026-03-02T10:00:00Z", 6.0),
                           run_at(3, "<yesterday>", 6.0), run_at(4, "2026-03-09T10:00:00Z", 6.0)};
  runs[0].result.guided = true;
  const auto trials = after_breaks(runs);
  REQUIRE(trials.size() == 1);
  CHECK(trials[0].run == 2);
  CHECK(graded_trials({}).empty());
}
