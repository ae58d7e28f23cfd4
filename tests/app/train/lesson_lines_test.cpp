// What a script reads of a lesson.
#include "app/train/lesson_lines.h"

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

using Lines = std::vector<std::string>;

// So far, its first cycle at `begin` [s].
CoachView trial(double begin, std::size_t step, Lines said = {}, double duration = 1.0) {
  CoachView coach;
  coach.phase = LessonPhase::driving;
  coach.lesson = "moving_off";
  coach.result.begin = begin;
  coach.result.duration = duration;
  coach.now = {"Go.", "", step, 3, kNeutralGear, std::move(said)};
  return coach;
}

CoachView not_begun() {
  return trial(0.0, 0, {}, 0.0);
}

CoachView over(double begin, LessonEnd end, Lines said = {}) {
  CoachView coach = trial(begin, 3, std::move(said), 20.0);
  coach.phase = LessonPhase::over;
  coach.result.end = end;
  coach.result.grade = 9.5;
  coach.result.passed = end == LessonEnd::done;
  coach.result.why = coach.result.passed ? "" : "The lesson was left.";
  return coach;
}

}  // namespace

TEST_CASE("a trial is told from its first cycle on, each step, each sentence and its end once") {
  LessonLines lines;
  CHECK(lines.news(not_begun()) == Lines{});  // no cycle yet
  CHECK(lines.news(trial(2.0, 0)) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
  CHECK(lines.news(trial(2.0, 0)) == Lines{});
  CHECK(lines.news(trial(2.0, 1, {"a"})) == Lines{"step 2 of 3: Go.", "a"});
  CHECK(lines.news(over(2.0, LessonEnd::done, {"a", "b"})) ==
        Lines{"b", "lesson moving_off is over: grade 9.5 of 10, passed"});
  CHECK(lines.news(over(2.0, LessonEnd::done, {"a", "b"})) == Lines{});
}

TEST_CASE("a trial that follows within a frame is another one, in the same step, too, and its sentences are its own") {
  LessonLines lines;
  (void)lines.news(trial(2.0, 0, {"a"}));
  CHECK(lines.news(trial(5.0, 0, {"c"})) ==
        Lines{"that trial was left", "lesson moving_off begins", "step 1 of 3: Go.", "c"});
  CHECK(lines.news(over(5.0, LessonEnd::done, {"c"})).size() == 1);
  CHECK(lines.news(not_begun()) == Lines{});  // again
  CHECK(lines.news(trial(9.0, 0)) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
}

TEST_CASE("where there is no grade none is told") {
  LessonLines lines;
  (void)lines.news(trial(2.0, 0));
  CHECK(lines.news(over(2.0, LessonEnd::left)) ==
        Lines{"lesson moving_off is over: not graded, not passed: The lesson was left."});
}

TEST_CASE("a trial whose first cycle is at 0 s, as on a virtual clock, is told as any other, the one after it, too") {
  LessonLines lines;
  for (int i = 0; i < 2; ++i) {
    CHECK(lines.news(trial(0.0, 0)) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
    CHECK(lines.news(trial(0.0, 1, {"a"}, 2.0)) == Lines{"step 2 of 3: Go.", "a"});
    CHECK(lines.news(over(0.0, LessonEnd::done, {"a"})) == Lines{"lesson moving_off is over: grade 9.5 of 10, passed"});
  }
  CHECK(lines.news(trial(0.0, 0, {}, 5.0)).size() == 2);
  CHECK(lines.news(trial(0.0, 0, {}, 0.1)) ==
        Lines{"that trial was left", "lesson moving_off begins", "step 1 of 3: Go."});
}

TEST_CASE("a trial that makes way for another offer or for none was left, and that is told once") {
  for (const LessonPhase next : {LessonPhase::offered, LessonPhase::none}) {
    LessonLines lines;
    (void)lines.news(trial(2.0, 0));
    CoachView coach;
    coach.phase = next;
    coach.lesson = next == LessonPhase::none ? "" : "hill_start";
    coach.goal = "Go up.";
    Lines told{"lesson moving_off was left"};
    if (next == LessonPhase::offered) told.emplace_back("lesson hill_start is offered: Go up.");
    CHECK(lines.news(coach) == told);
    CHECK(lines.news(coach) == Lines{});
  }
}
