// Tests how a grade is computed. Each deducted point belongs to a driving error.
#include "app/lessons/assessment/grade.h"

#include <utility>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

Lesson lesson_that_catches(std::vector<ErrorKind> kinds) {
  Lesson lesson;
  lesson.pass_grade = 6.0;
  lesson.time_limit = 90.0;
  lesson.fails_on = std::move(kinds);
  return lesson;
}

LessonResult done_with(const std::vector<Severity>& severities) {
  LessonResult result;
  result.end = LessonEnd::done;
  for (const Severity severity : severities)
    result.errors.push_back(make_driving_error(ErrorKind::jerk, severity, 1.0, 60.0, 0));
  return result;
}

LessonResult graded(LessonResult result, const Lesson& lesson = lesson_that_catches({})) {
  grade_result(lesson, result);
  return result;
}

}  // namespace

TEST_CASE(
    "from ten points, a minor error deducts half a point, a severe one two, a very severe one four, a note none") {
  CHECK(graded(done_with({})).grade == 10.0);
  CHECK(graded(done_with({Severity::note})).grade == 10.0);
  CHECK(graded(done_with({Severity::minor})).grade == 9.5);
  CHECK(graded(done_with({Severity::severe, Severity::minor})).grade == 7.5);
  CHECK(graded(done_with({Severity::very_severe, Severity::severe, Severity::minor, Severity::note})).grade == 3.5);
}

TEST_CASE("every error that is no note costs points, and together they are the points missing from ten") {
  const LessonResult result =
      graded(done_with({Severity::note, Severity::minor, Severity::severe, Severity::note, Severity::very_severe}));
  std::vector<double> points;
  for (const DrivingError& error : result.errors) points.push_back(error.points);
  CHECK(points == std::vector<double>{0.0, 0.5, 2.0, 0.0, 4.0});
  CHECK(points_lost(result) == 6.5);
  CHECK(result.grade == 3.5);
}

TEST_CASE("an unfinished lesson has grade 0 even without errors; one that the learner left has no grade") {
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

TEST_CASE("no grade is below zero") {
  CHECK(graded(done_with(std::vector<Severity>(5, Severity::very_severe))).grade == 0.0);
}

TEST_CASE("a lesson is passed from the pass grade on; otherwise one sentence gives the reason") {
  const LessonResult at = graded(done_with({Severity::very_severe}));
  CHECK(at.passed);
  CHECK(at.why.empty());
  const LessonResult below = graded(done_with({Severity::very_severe, Severity::minor}));
  CHECK_FALSE(below.passed);
  CHECK(below.why == "Grade 5.5 is below the pass grade of 6.0.");
}

TEST_CASE("an error that fails the lesson fails it at any grade, and its sentence is the reason") {
  LessonResult stalled = done_with({});
  stalled.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 3.0, 90.0, -1));
  const LessonResult result = graded(stalled, lesson_that_catches({ErrorKind::stall}));
  CHECK(result.grade == 8.0);
  CHECK_FALSE(result.passed);
  CHECK(result.why == "The engine stalled: it fell from 859 rpm within a second.");
  CHECK(graded(stalled).passed);
}

TEST_CASE("an error on which the lesson fails fails it, minor or severe; one that is only counted costs points") {
  for (const Severity severity : {Severity::minor, Severity::severe}) {
    Lesson lesson = lesson_that_catches({ErrorKind::jerk});
    CHECK_FALSE(graded(done_with({severity}), lesson).passed);
    lesson.counted = std::exchange(lesson.fails_on, {});
    const LessonResult result = graded(done_with({severity}), lesson);
    CHECK(result.passed);
    CHECK(result.grade == 10.0 - points_of(severity));
  }
}

TEST_CASE("a slow step fails the lesson from its fails_after on, or without that from its within on") {
  Lesson lesson = lesson_that_catches({ErrorKind::slow_step});
  LessonStep step;
  step.prompt = "Stop!";
  step.within = 4.0;
  lesson.steps = {step};
  LessonResult slow = done_with({});
  slow.errors.push_back(make_driving_error(ErrorKind::slow_step, Severity::minor, 9.0, 4.5));
  slow.errors[0].step = "Stop!";
  slow.errors[0].time_limit = 4.0;
  CHECK_FALSE(graded(slow, lesson).passed);
  lesson.steps[0].fails_after = 4.6;
  CHECK(graded(slow, lesson).passed);
  CHECK(graded(slow, lesson).grade == 9.5);
  slow.errors[0].duration = 4.6;
  CHECK_FALSE(graded(slow, lesson).passed);
  CHECK(graded(slow, lesson).why == "You took 4.6 s for this step (limit 4.0 s): \"Stop!\"");
}

TEST_CASE("only a finished lesson can be passed") {
  LessonResult result = done_with({});
  result.end = LessonEnd::out_of_time;
  CHECK(graded(result).why == "Not finished within 90 s.");
  result.end = LessonEnd::left;
  CHECK(graded(result).why == "You left the lesson.");
  LessonResult stalled = result;  // leaving the lesson is named as the reason, even after a stall
  stalled.errors.push_back(make_driving_error(ErrorKind::stall, Severity::very_severe, 3.0, 62.0, -1));
  CHECK(graded(stalled, lesson_that_catches({ErrorKind::stall})).why == "You left the lesson.");
  result.end = LessonEnd::running;
  CHECK_FALSE(graded(result).passed);
  result.end = LessonEnd::aborted;
  result.why = "The car rolled back more than a metre.";
  CHECK(graded(result).why == "The car rolled back more than a metre.");
  CHECK_FALSE(graded(result).passed);
}

TEST_CASE("a guided trial and an incomplete record have no grade") {
  LessonResult guided = done_with({Severity::minor});
  guided.guided = true;
  guided = graded(guided);
  CHECK(guided.grade == 0.0);
  CHECK(points_lost(guided) == 0.0);
  CHECK_FALSE(guided.passed);
  CHECK(guided.why == "Not graded: the lever was guiding you.");
  LessonResult torn = done_with({});
  torn.is_complete = false;
  CHECK_FALSE(graded(torn).passed);
  CHECK(graded(torn).grade == 0.0);
}

TEST_CASE("the run's error is the sum of its errors' points, guided or not") {
  LessonResult result = done_with({Severity::minor, Severity::minor, Severity::severe, Severity::note});
  CHECK(run_error(result) == doctest::Approx(0.3));
  result.guided = true;
  CHECK(run_error(result) == doctest::Approx(0.3));
  result.end = LessonEnd::aborted;
  CHECK(run_error(result) == 1.0);
  CHECK(run_error(done_with(std::vector<Severity>(9, Severity::very_severe))) == 1.0);
}
