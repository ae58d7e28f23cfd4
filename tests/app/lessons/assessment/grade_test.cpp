// Tests how a grade is computed. Each deducted point belongs to a driving error.
#include "app/lessons/assessment/grade.h"

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "haptics/files/number_text.h"

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

// Clutch heat of 1 kJ, with a standard deviation of its logarithm of 0.1. Two of them pass.
Norm one_figure_norm() {
  Norm norm;
  norm.figures[0] = FigureNorm{1000.0, std::exp(0.1)};
  norm.limit = 2.0;
  return norm;
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
  CHECK(graded(done_with(std::vector<Severity>(3, Severity::minor))).grade == 8.5);
  CHECK(points_lost(graded(done_with({Severity::severe, Severity::minor}))) == 2.5);
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
  const LessonResult at = graded(done_with(std::vector<Severity>(8, Severity::minor)));
  CHECK(at.grade == 6.0);
  CHECK(at.passed);
  CHECK(at.why.empty());
  const LessonResult below = graded(done_with(std::vector<Severity>(9, Severity::minor)));
  CHECK_FALSE(below.passed);
  CHECK(below.why == "Grade 5.5 is below the pass grade of 6.0.");
}

TEST_CASE("an error that fails the lesson also puts the grade below the pass grade, and its sentence is the reason") {
  LessonResult stalled = done_with({});
  stalled.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 3.0, 90.0, -1));
  for (const Lesson& lesson : {lesson_that_catches({ErrorKind::stall}), lesson_that_catches({})}) {
    const LessonResult result = graded(stalled, lesson);  // a severe error fails every lesson
    CHECK(result.grade == doctest::Approx(5.9));
    CHECK_FALSE(result.passed);
    CHECK(result.why == "The engine stalled: it fell from 859 rpm within a second.");
  }
}

TEST_CASE("a minor error fails a lesson that fails on it; where it is only counted it costs points") {
  Lesson lesson = lesson_that_catches({ErrorKind::jerk});
  CHECK_FALSE(graded(done_with({Severity::minor}), lesson).passed);
  lesson.counted = std::exchange(lesson.fails_on, {});
  const LessonResult result = graded(done_with({Severity::minor}), lesson);
  CHECK(result.passed);
  CHECK(result.grade == 9.5);
}

TEST_CASE("grade and verdict agree for random errors, pass grades and scores, also as shown with one decimal") {
  std::mt19937_64 random(1);
  const auto below = [&](std::uint64_t n) { return static_cast<int>(random() % n); };
  int passed = 0;
  for (int i = 0; i < 20000; ++i) {
    Lesson lesson = lesson_that_catches({});
    lesson.pass_grade = 1.0 + 0.1 * below(91);
    if (below(3) == 0) lesson.fails_on = {ErrorKind::jerk};
    std::vector<Severity> severities;
    for (int n = below(6); n > 0; --n) severities.push_back(static_cast<Severity>(below(3)));
    LessonResult result = done_with(severities);
    for (DrivingError& error : result.errors)
      if (error.severity == Severity::note) error.kind = ErrorKind::lugging;
    const Norm norm = one_figure_norm();
    result.slip_energy = 1000.0 * std::exp(0.01 * below(200));
    grade_result(lesson, result, below(4) == 0 ? nullptr : &norm);
    CAPTURE(result.grade);
    CAPTURE(lesson.pass_grade);
    CHECK(result.passed == (result.grade >= lesson.pass_grade - 1e-9));
    CHECK(result.passed == (std::stod(gearshift::haptics::fixed_text(result.grade, 1)) >= lesson.pass_grade - 1e-9));
    CHECK(result.passed == result.why.empty());
    CHECK(result.grade <= 10.0);
    CHECK(result.grade >= 0.0);
    passed += result.passed ? 1 : 0;
  }
  CHECK(passed > 2000);
  CHECK(passed < 18000);
}

TEST_CASE("the grade falls with the distance from practised drivers, and is the pass grade at the limit") {
  const Norm norm = one_figure_norm();
  const auto at = [&](double deviations) {
    LessonResult result = done_with({});
    result.slip_energy = 1000.0 * std::exp(0.1 * deviations);  // the norm's standard deviation is exp(0.1)
    Lesson lesson = lesson_that_catches({});
    grade_result(lesson, result, &norm);
    return result;
  };
  CHECK(at(-3.0).grade == 10.0);  // less heat than practised drivers is no fault
  CHECK(at(1.0).grade == 10.0);   // half of the limit of 2
  CHECK(at(1.5).grade == doctest::Approx(8.0));
  CHECK(at(1.999).passed);
  CHECK(at(1.999).grade == doctest::Approx(6.0));
  CHECK(*at(2.0).score == doctest::Approx(1.0));
  const LessonResult beyond = at(2.5);
  CHECK_FALSE(beyond.passed);
  CHECK(beyond.grade == doctest::Approx(5.2));  // 6 (1 - 0.25 / 2) = 5.25, rounded down
  CHECK(beyond.grading == Grading::norm);
  CHECK(beyond.why ==
        "Not yet as smooth as practised drivers. Farthest off: Clutch heat, 1.28 kJ (norm: up to 1.18 kJ).");
  CHECK(at(9.0).grade == doctest::Approx(1.5));  // deviations above 5 count as 5: 6 (1 - 1.5 / 2)
  CHECK(graded(done_with({})).grading == Grading::errors);
  CHECK_FALSE(graded(done_with({})).score);
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
  guided.lever_help = 0.5;
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
  CHECK(lever_error(result, nullptr) == 0.0);  // a jerk is the foot's
  CHECK(pedal_error(result, nullptr) == doctest::Approx(0.3));
  result.end = LessonEnd::done;
  result.errors = {make_driving_error(ErrorKind::wrong_column, Severity::minor, 1.0, 1.0),
                   make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 60.0)};
  CHECK(run_error(result) == doctest::Approx(0.25));
  CHECK(lever_error(result, nullptr) == doctest::Approx(0.05));
  CHECK(pedal_error(result, nullptr) == doctest::Approx(0.2));
  result.score = 1.0;  // as far from practised drivers as a pass allows: 4 of 10 points
  CHECK(run_error(result) == doctest::Approx(0.4));
  CHECK(run_error(done_with(std::vector<Severity>(9, Severity::very_severe))) == 1.0);
}

TEST_CASE("the error of a limb grows with the distance of its own figures") {
  Norm norm;
  norm.limit = 1.0;
  norm.figures[0] = FigureNorm{500.0, 2.0};  // clutch heat
  norm.figures[5] = FigureNorm{1.1, 1.1};    // path of the lever
  LessonResult result = done_with({});
  result.score = 1.0;
  result.slip_energy = 500.0;
  result.figures.path_efficiency = 1.1 * 1.1 * 1.1;  // two standard deviations: twice the limit, half the grade of 6
  CHECK(lever_error(result, &norm) == doctest::Approx(0.3));
  CHECK(pedal_error(result, &norm) == 0.0);
  result.slip_energy = 2000.0;
  result.figures.path_efficiency = 1.0;
  CHECK(lever_error(result, &norm) == 0.0);
  CHECK(pedal_error(result, &norm) == doctest::Approx(0.3));
  result.slip_energy = 1000.0;  // at the limit: no error yet
  CHECK(pedal_error(result, &norm) == 0.0);
  result.score.reset();  // another car: the norm did not judge this run
  CHECK(pedal_error(result, &norm) == 0.0);
}

TEST_CASE("what was good is the first that holds, and nothing is praised that went wrong") {
  LessonResult result = done_with({});
  result.duration = 20.0;
  CHECK(what_was_good(result) == "every step, without an error.");
  result.errors = {make_driving_error(ErrorKind::jerk, Severity::minor, 1.0, 2.0)};
  CHECK(what_was_good(result) == "the engine kept running.");
  result.shifts.resize(2);
  CHECK(what_was_good(result) == "the lever found its gears, without grinding.");
  result.errors.push_back(make_driving_error(ErrorKind::grind, Severity::severe, 1.0, 2.0));
  CHECK(what_was_good(result) == "the engine kept running.");
  result.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 60.0));
  CHECK(what_was_good(result) == "you finished every step.");
  result.end = LessonEnd::aborted;
  CHECK(what_was_good(result).empty());
  result.errors.clear();
  result.end = LessonEnd::left;
  CHECK(what_was_good(result).empty());
}

TEST_CASE("the thing to mend is the error or the figure that failed the run, whatever else went wrong") {
  Lesson lesson;
  Norm norm;
  norm.figures[0] = FigureNorm{500.0, 2.0};
  norm.figures[5] = FigureNorm{1.1, 1.1};
  const auto mend = [&](LessonResult result) {
    grade_result(lesson, result, &norm);
    return std::string(thing_to_mend(lesson, result, &norm));
  };
  LessonResult hot = done_with({Severity::minor});
  hot.slip_energy = 50e3;
  hot.figures.path_efficiency = 1.1;
  CHECK(mend(hot) == kRunFigures[0].advice);
  LessonResult crooked = hot;
  crooked.slip_energy = 500.0;
  crooked.figures.path_efficiency = 3.0;
  CHECK(mend(crooked) == kRunFigures[5].advice);
  LessonResult stalled = crooked;
  stalled.errors.push_back(make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 60.0));
  CHECK(mend(stalled) == error_advice(ErrorKind::stall));
  LessonResult good = done_with({});
  good.slip_energy = 500.0;
  good.figures.path_efficiency = 1.1;
  CHECK(mend(good).empty());
  good.errors.push_back(make_driving_error(ErrorKind::riding_clutch, Severity::minor, 1.0, 3.0));
  CHECK(mend(good) == error_advice(ErrorKind::riding_clutch));
  for (const RunFigure& figure : kRunFigures) CHECK_FALSE(figure.advice.empty());
}
