// The arithmetic of grades, and that every point names its fault.
#include "app/training/grade.h"

#include <utility>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

Lesson lesson_that_catches(std::vector<FaultKind> kinds) {
  Lesson lesson;
  lesson.pass_grade = 6.0;
  lesson.time_limit = 90.0;
  lesson.catches = std::move(kinds);
  return lesson;
}

LessonResult done_with(const std::vector<Severity>& severities) {
  LessonResult result;
  result.end = LessonEnd::done;
  for (const Severity severity : severities) result.faults.push_back({FaultKind::jerk, severity, 1.0, 60.0, 0});
  return result;
}

LessonResult graded(LessonResult result, const Lesson& lesson = lesson_that_catches({})) {
  grade_result(lesson, result);
  return result;
}

}  // namespace

TEST_CASE("ten points, less half for a minor fault, two for a severe, four for a very severe, none for a note") {
  CHECK(graded(done_with({})).grade == 10.0);
  CHECK(graded(done_with({Severity::note})).grade == 10.0);
  CHECK(graded(done_with({Severity::minor})).grade == 9.5);
  CHECK(graded(done_with({Severity::severe, Severity::minor})).grade == 7.5);
  CHECK(graded(done_with({Severity::very_severe, Severity::severe, Severity::minor, Severity::note})).grade == 3.5);
}

TEST_CASE("every deduction names its fault, and together they are what is missing") {
  const LessonResult result =
      graded(done_with({Severity::note, Severity::minor, Severity::severe, Severity::note, Severity::very_severe}));
  REQUIRE(result.deductions.size() == 3);
  double sum = 0.0;
  for (const Deduction& deduction : result.deductions) {
    REQUIRE(deduction.fault < result.faults.size());
    CHECK(deduction.points == points_of(result.faults[deduction.fault].severity));
    sum += deduction.points;
  }
  CHECK(result.grade == 10.0 - sum);
}

TEST_CASE("a lesson that was not done has grade 0 without a fault, and one that was left has none at all") {
  for (const LessonEnd end : {LessonEnd::aborted, LessonEnd::out_of_time}) {
    LessonResult lost = done_with({});
    lost.end = end;
    lost = graded(lost);
    CHECK(lost.grade == 0.0);
    CHECK_FALSE(lost.passed);
    CHECK(is_graded(lost));
  }
  LessonResult left = done_with({});
  left.end = LessonEnd::left;
  CHECK_FALSE(is_graded(graded(left)));
  CHECK_FALSE(graded(left).passed);
  CHECK(is_graded(graded(done_with({}))));
}

TEST_CASE("no grade is below nought") {
  CHECK(graded(done_with(std::vector<Severity>(5, Severity::very_severe))).grade == 0.0);
}

TEST_CASE("passed at the pass grade and above, and why not in one sentence") {
  const LessonResult at = graded(done_with({Severity::very_severe}));
  CHECK(at.passed);
  CHECK(at.why.empty());
  const LessonResult below = graded(done_with({Severity::very_severe, Severity::minor}));
  CHECK_FALSE(below.passed);
  CHECK(below.why == "Grade 5.5 is below 6.0.");
}

TEST_CASE("one fault that fails the lesson fails it at any grade, with its own sentence") {
  LessonResult stalled = done_with({});
  stalled.faults.push_back({FaultKind::stall, Severity::severe, 3.0, 90.0, -1});
  const LessonResult result = graded(stalled, lesson_that_catches({FaultKind::stall}));
  CHECK(result.grade == 8.0);
  CHECK_FALSE(result.passed);
  CHECK(result.why == "The engine stalled, from 859 rpm.");
  CHECK(graded(stalled).passed);
}

TEST_CASE("minor or severe: what the lesson catches is not passed, what it only counts costs its points") {
  for (const Severity severity : {Severity::minor, Severity::severe}) {
    Lesson lesson = lesson_that_catches({FaultKind::jerk});
    CHECK_FALSE(graded(done_with({severity}), lesson).passed);
    lesson.counts = std::exchange(lesson.catches, {});
    const LessonResult result = graded(done_with({severity}), lesson);
    CHECK(result.passed);
    CHECK(result.grade == 10.0 - points_of(severity));
  }
}

TEST_CASE("a slow step fails from its own limit on, and where it has none from within_s on") {
  Lesson lesson = lesson_that_catches({FaultKind::slow_step});
  LessonStep step;
  step.prompt = "Stop!";
  step.within = 4.0;
  lesson.steps = {step};
  LessonResult slow = done_with({});
  slow.faults.push_back({FaultKind::slow_step, Severity::minor, 9.0, 4.5, -1, "Stop!", 4.0});
  CHECK_FALSE(graded(slow, lesson).passed);
  lesson.steps[0].fails_after = 4.6;
  CHECK(graded(slow, lesson).passed);
  CHECK(graded(slow, lesson).grade == 9.5);
  slow.faults[0].value = 4.6;
  CHECK_FALSE(graded(slow, lesson).passed);
  CHECK(graded(slow, lesson).why == "\"Stop!\" took 4.6 s; 4.0 s is wanted.");
}

TEST_CASE("only what was done is passed") {
  LessonResult result = done_with({});
  result.end = LessonEnd::out_of_time;
  CHECK(graded(result).why == "It was not done in 90 s.");
  result.end = LessonEnd::left;
  CHECK(graded(result).why == "The lesson was left.");
  LessonResult stalled = result;  // who leaves is told that, whatever was wrong before
  stalled.faults.push_back({FaultKind::stall, Severity::very_severe, 3.0, 62.0, -1});
  CHECK(graded(stalled, lesson_that_catches({FaultKind::stall})).why == "The lesson was left.");
  result.end = LessonEnd::running;
  CHECK_FALSE(graded(result).passed);
  result.end = LessonEnd::aborted;
  result.why = "The car rolled back more than a metre.";
  CHECK(graded(result).why == "The car rolled back more than a metre.");
  CHECK_FALSE(graded(result).passed);
}

TEST_CASE("a guided trial and a torn record have no grade, however good") {
  LessonResult guided = done_with({Severity::minor});
  guided.guided = true;
  guided = graded(guided);
  CHECK(guided.grade == 0.0);
  CHECK(guided.deductions.empty());
  CHECK_FALSE(guided.passed);
  CHECK(guided.why == "The lever was guided: such a trial is not graded.");
  LessonResult torn = done_with({});
  torn.whole = false;
  CHECK_FALSE(graded(torn).passed);
  CHECK(graded(torn).grade == 0.0);
}

TEST_CASE("faults are counted by severity, and an error is their points, guided or not") {
  LessonResult result = done_with({Severity::minor, Severity::minor, Severity::severe, Severity::note});
  CHECK(count_by_severity(result.faults) == std::array<std::size_t, 4>{1, 2, 1, 0});
  CHECK(run_error(result) == doctest::Approx(0.3));
  result.guided = true;
  CHECK(run_error(result) == doctest::Approx(0.3));
  result.end = LessonEnd::aborted;
  CHECK(run_error(result) == 1.0);
  CHECK(run_error(done_with(std::vector<Severity>(9, Severity::very_severe))) == 1.0);
}
