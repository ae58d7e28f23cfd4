// The lines about a lesson that the program prints for scripts.
#include "app/session/lesson_lines.h"

#include <doctest/doctest.h>

#include "tests/app/ui/panel/coach_views.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::session;
using gearshift::test::CoachState;

namespace {

using Lines = std::vector<std::string>;

// The coach's state in a trial that began at `begin` [s] and has lasted `duration` seconds.
CoachState trial(double begin, std::size_t step, Lines feedback = {}, double duration = 1.0) {
  CoachState coach;
  coach.phase = LessonPhase::driving;
  coach.lesson = "moving_off";
  coach.result.begin = begin;
  coach.result.duration = duration;
  coach.now = {"Go.", "", step, 3, kNeutralGear, std::move(feedback)};
  return coach;
}

CoachState not_begun() {
  return trial(0.0, 0, {}, 0.0);
}

CoachState over(double begin, LessonEnd end, Lines feedback = {}) {
  CoachState coach = trial(begin, 3, std::move(feedback), 20.0);
  coach.phase = LessonPhase::over;
  coach.result.end = end;
  coach.result.grade = 9.5;
  coach.result.passed = end == LessonEnd::done;
  coach.result.why = coach.result.passed ? "" : "You left the lesson.";
  return coach;
}

}  // namespace

TEST_CASE("a trial is reported from its first cycle on; its steps, its messages and its end are each reported once") {
  LessonLines lines;
  CHECK(lines.new_lines(not_begun().view()) == Lines{});  // the trial has no cycle yet
  CHECK(lines.new_lines(trial(2.0, 0).view()) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
  CHECK(lines.new_lines(trial(2.0, 0).view()) == Lines{});
  CHECK(lines.new_lines(trial(2.0, 1, {"a"}).view()) == Lines{"step 2 of 3: Go.", "a"});
  CHECK(lines.new_lines(over(2.0, LessonEnd::done, {"a", "b"}).view()) ==
        Lines{"b", "lesson moving_off is over: grade 9.5/10, passed"});
  CHECK(lines.new_lines(over(2.0, LessonEnd::done, {"a", "b"}).view()) == Lines{});
}

TEST_CASE("a trial that replaces the previous one within a frame is reported as new, even if the step is the same") {
  LessonLines lines;
  (void)lines.new_lines(trial(2.0, 0, {"a"}).view());
  CHECK(lines.new_lines(trial(5.0, 0, {"c"}).view()) ==
        Lines{"previous attempt ended early", "lesson moving_off begins", "step 1 of 3: Go.", "c"});
  CHECK(lines.new_lines(over(5.0, LessonEnd::done, {"c"}).view()).size() == 1);
  CHECK(lines.new_lines(not_begun().view()) == Lines{});  // the next trial has no cycle yet
  CHECK(lines.new_lines(trial(9.0, 0).view()) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
}

TEST_CASE("a trial without a grade is reported as not graded") {
  LessonLines lines;
  (void)lines.new_lines(trial(2.0, 0).view());
  CHECK(lines.new_lines(over(2.0, LessonEnd::left).view()) ==
        Lines{"lesson moving_off is over: not graded. You left the lesson."});
}

TEST_CASE("trials whose first cycle is at 0 s, as on a virtual clock, are reported like any others") {
  LessonLines lines;
  for (int i = 0; i < 2; ++i) {
    CHECK(lines.new_lines(trial(0.0, 0).view()) == Lines{"lesson moving_off begins", "step 1 of 3: Go."});
    CHECK(lines.new_lines(trial(0.0, 1, {"a"}, 2.0).view()) == Lines{"step 2 of 3: Go.", "a"});
    CHECK(lines.new_lines(over(0.0, LessonEnd::done, {"a"}).view()) ==
          Lines{"lesson moving_off is over: grade 9.5/10, passed"});
  }
  CHECK(lines.new_lines(trial(0.0, 0, {}, 5.0).view()).size() == 2);
  CHECK(lines.new_lines(trial(0.0, 0, {}, 0.1).view()) ==
        Lines{"previous attempt ended early", "lesson moving_off begins", "step 1 of 3: Go."});
}

TEST_CASE("a trial replaced by a different offer, or by none, is reported once as ended early") {
  for (const LessonPhase next : {LessonPhase::offered, LessonPhase::none}) {
    LessonLines lines;
    (void)lines.new_lines(trial(2.0, 0).view());
    CoachState coach;
    coach.phase = next;
    coach.lesson = next == LessonPhase::none ? "" : "hill_start";
    coach.goal = "Go up.";
    Lines expected{"lesson moving_off ended early"};
    if (next == LessonPhase::offered) expected.emplace_back("lesson hill_start is ready to start: Go up.");
    CHECK(lines.new_lines(coach.view()) == expected);
    CHECK(lines.new_lines(coach.view()) == Lines{});
  }
}
