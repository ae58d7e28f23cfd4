// Parses the page's tables and drawings. They must show the data from which the page was made, and users' text must
// appear as text, not as markup.
#include "app/lessons/report/report_page.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "app/lessons/assessment/learning_curve.h"
#include "app/lessons/report/report_text.h"
#include "tests/app/lessons/report/constructed_history.h"
#include "tests/app/lessons/report/page_parts.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

std::vector<Lesson> two_lessons() {
  std::vector<Lesson> lessons(2);
  lessons[0].key = "drill";
  lessons[0].title = "The drill";
  lessons[0].task = "upshift";
  lessons[1].key = "reverse";
  lessons[1].title = "Reverse";
  lessons[1].task = "reverse";
  return lessons;
}

std::string page_of(const LearnerHistory& history) {
  return report_page(history, show_shifts(history, "/nowhere"), two_lessons());
}

LearnerHistory learner(int runs) {
  LearnerHistory history;
  history.learner.name = "Ada";
  // The grade of run i is 8 - 5 exp(-i / 4), with an alternating scatter of +- 0.1.
  for (int i = 0; i < runs; ++i)
    history.runs.push_back(run_with(i + 1, 4, 8.0 - 5.0 * std::exp(-i / 4.0) + (i % 2 == 0 ? 0.1 : -0.1)));
  return history;
}

bool has(std::string_view page, std::string_view words) {
  return page.find(words) != std::string_view::npos;
}

// The centres of the dots in a chart.
std::vector<std::pair<double, double>> dots_of(std::string_view svg) {
  std::vector<std::pair<double, double>> dots;
  for (std::size_t at = 0;;) {
    const std::string_view dot = between(svg, "<circle ", ">", at);
    if (at == std::string_view::npos) return dots;
    if (has(dot, "fill=\"none\"")) continue;
    dots.emplace_back(std::stod(std::string(between(dot, "cx=\"", "\""))),
                      std::stod(std::string(between(dot, "cy=\"", "\""))));
  }
}

}  // namespace

TEST_CASE("the totals of days, sessions, runs, shifts and minutes equal those of the rows") {
  LearnerHistory history = learner(5);
  history.runs[1].begun_at = "2026-01-02T19:00:00Z";  // the same day as the first run
  history.runs[0].begun_at = "2026-01-02T09:00:00Z";
  history.runs[1].session = history.runs[0].session;
  history.runs[4].result.duration = 90.0;
  const std::string page = page_of(history);
  CHECK(text_of_id(page, "days") == "4");
  CHECK(text_of_id(page, "sessions") == "4");
  CHECK(text_of_id(page, "lesson-runs") == "5");
  CHECK(text_of_id(page, "shift-count") == "20");
  CHECK(text_of_id(page, "minutes") == "5.5");
  CHECK(has(page, "2026-01-02 to 2026-01-06"));
}

TEST_CASE("the next lesson is the instructor's, otherwise the suggested one, with its reason") {
  LearnerHistory history = learner(1);
  history.runs[0].result.passed = true;
  history.runs[0].result.grade = 9.0;
  CHECK(has(page_of(history), "Next lesson: <strong>Reverse</strong>. You haven't passed Reverse yet."));
  history.learner.next_lesson = "drill";
  const std::string page = page_of(history);
  CHECK(has(page, "Next lesson: <strong>The drill</strong>, chosen by the instructor."));
  CHECK(has(page, "Based on the grades, the next lesson would be Reverse. You haven't passed Reverse yet."));
  history.learner.next_lesson = "lessons/reverse.toml";  // ignored, because the coach does not offer this lesson
  CHECK(has(page_of(history), "Next lesson: <strong>Reverse</strong>. You haven't passed Reverse yet."));
}

TEST_CASE("runs, newest first: day, lesson, mode, grade, result, every error with its points, comments") {
  LearnerHistory history = learner(2);
  LessonResult& result = history.runs[1].result;
  result.grade = 3.5;
  result.passed = false;
  result.why = "Grade 3.5 is below 6.0.";
  result.begin = 100.0;
  result.errors = {make_driving_error(ErrorKind::clutch_early, Severity::severe, 112.4, 0.12, 2),
                   make_driving_error(ErrorKind::stall, Severity::very_severe, 130.0, 40.0, -1),
                   make_driving_error(ErrorKind::jerk, Severity::note, 131.0, 12.5, -1)};
  result.errors[0].points = 2.0;
  result.errors[1].points = 4.0 + 0.5;
  history.runs[1].comments = {{"2026-01-09T10:00:00Z", "Bo", "Calmer at the bite point."},
                              {"2026-01-10T10:00:00Z", "Di", "Better.", 2, "2026-01-11T10:00:00Z"}};
  const std::string page = page_of(history);
  const auto rows = table_of(page, "runs");
  REQUIRE(rows.size() == 2);
  REQUIRE(rows[0].size() == 7);
  CHECK(rows[0][0] == "2");
  CHECK(has(rows[0][1], "2026-01-03"));
  CHECK(has(rows[0][1], "10:00"));
  CHECK(has(rows[0][2], "The drill"));
  CHECK(has(rows[0][2], "do it yourself"));
  CHECK(rows[0][3] == "4");
  CHECK(rows[0][4] == "3.5");
  CHECK(has(rows[0][5], "not passed"));
  CHECK(has(rows[0][5], "Grade 3.5 is below 6.0."));
  CHECK(has(rows[0][6], "−2.0  The clutch came up 0.12 s before the gear was in.  (12.4 s into the run, shift 3)"));
  CHECK(has(rows[0][6], "−4.5  The engine stalled: it fell from 382 rpm within a second.  (30.0 s into the run)"));
  CHECK(has(rows[0][6], "Note: The car jerked (12 m/s³)."));
  CHECK(has(rows[0][6], "Calmer at the bite point."));
  CHECK(has(rows[0][6], "Bo, 2026-01-09 "));
  CHECK(has(rows[0][6], "Di, 2026-01-10, edited 2026-01-11"));
  CHECK(rows[1][0] == "1");
  CHECK(rows[1][4] == "3.1");
  CHECK(rows[1][6].empty());
}

TEST_CASE(
    "a run shows its figures, and the page says where the norm is from; an old run says that its rule was another") {
  LearnerHistory history = learner(2);
  LessonResult& result = history.runs[1].result;
  result.grading = Grading::norm;
  result.score = 0.8;
  result.slip_energy = 1250.0;
  result.figures.jerk_peak = 31.0;
  history.runs[0].result.grading = Grading::old_rule;
  const std::string page = page_of(history);
  const auto rows = table_of(page, "runs");
  CHECK(has(rows[0][6], "Clutch heat 1.25 kJ; Largest jerk 31 m/s³"));
  CHECK(has(page, std::string(kNormOrigin)));
  CHECK(has(rows[1][5], "by the old rule"));
  CHECK_FALSE(has(rows[0][5], "by the old rule"));
  CHECK_FALSE(has(page_of(learner(2)), std::string(kNormOrigin)));
}

TEST_CASE("an error that cost no points shows its severity; more than ten lost points are shown as one sum") {
  LearnerHistory history = learner(2);
  LessonResult& guided = history.runs[0].result;
  guided.guided = true;
  guided.passed = false;
  guided.errors = {make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 40.0, -1),
                   make_driving_error(ErrorKind::jerk, Severity::very_severe, 1.0, 40.0, -1),
                   make_driving_error(ErrorKind::jerk, Severity::note, 1.0, 9.0, -1)};
  LessonResult& bad = history.runs[1].result;
  bad.grade = 0.0;
  bad.passed = false;
  bad.errors.assign(3, make_driving_error(ErrorKind::stall, Severity::very_severe, 1.0, 40.0, -1));
  bad.errors[0].points = 4.0;
  bad.errors[1].points = 4.0;
  bad.errors[2].points = 3.5;
  const auto rows = table_of(page_of(history), "runs");
  CHECK(has(rows[1][6], "Severe: The engine stalled"));
  CHECK(has(rows[1][6], "Very severe: The car jerked"));
  CHECK(has(rows[1][6], "Note: The car jerked"));
  CHECK(has(rows[0][5], "11.5 points lost; the lowest grade is 0"));
  CHECK_FALSE(has(rows[1][5], "points lost"));
  bad.errors[2].points = 2.0;
  CHECK_FALSE(has(table_of(page_of(history), "runs")[0][5], "points lost"));
}

TEST_CASE("a guided, damaged or unfinished run has no grade on the page, neither in tables nor in curves") {
  LearnerHistory history = learner(8);
  const std::string before(section_of(page_of(history), "learning"));
  const auto add = [&](auto&& change) {
    history.runs.push_back(run_with(static_cast<std::int64_t>(history.runs.size()) + 1, 3, 9.9));
    change(history.runs.back().result);
    history.runs.back().result.passed = false;
  };
  add([](LessonResult& r) { r.guided = true; });
  add([](LessonResult& r) { r.is_complete = false; });
  add([](LessonResult& r) { r.end = LessonEnd::running; });
  const std::string page = page_of(history);
  CHECK(section_of(page, "learning") == before);
  const auto rows = table_of(page, "runs");
  REQUIRE(rows.size() == 11);
  for (std::size_t i = 0; i < 3; ++i) CHECK(rows[i][4] == "–");
  CHECK_FALSE(has(page, "<strong>9.9"));
  // Control: a graded run changes this section.
  add([](LessonResult&) {});
  CHECK(section_of(page_of(history), "learning") != before);
}

TEST_CASE("the learning curve's dots are at the grades, and its figures are those of the fit") {
  const LearnerHistory history = learner(12);
  const std::string page = page_of(history);
  const std::string_view learning = section_of(page, "learning");
  const auto dots = dots_of(learning);
  REQUIRE(dots.size() == 12);
  // A dot's height must be a linear function of its grade, and the dots must be evenly spaced.
  const auto grade = [&](std::size_t i) { return history.runs[i].result.grade; };
  const double per_point = (dots[11].second - dots[0].second) / (grade(11) - grade(0));
  CHECK(per_point < 0.0);
  for (std::size_t i = 1; i < 12; ++i) {
    CHECK(dots[i].second - dots[0].second == doctest::Approx(per_point * (grade(i) - grade(0))).epsilon(1e-3));
    CHECK(dots[i].first - dots[i - 1].first == doctest::Approx(dots[1].first - dots[0].first).epsilon(1e-3));
  }
  const auto fit =
      fit_learning_curve(std::vector<double>{grade(0), grade(1), grade(2), grade(3), grade(4), grade(5), grade(6),
                                             grade(7), grade(8), grade(9), grade(10), grade(11)});
  REQUIRE(fit.has_value());
  const std::string caption = without_markup(between(learning, "<figcaption>", "</figcaption>"));
  double first = 0.0, now = 0.0, level = 0.0, low = 0.0, high = 0.0, noise = 0.0;
  REQUIRE(
      std::sscanf(caption.c_str(),
                  "The typical grade rose from %lf to %lf in 12 runs and should settle near %lf (most likely %lf to "
                  "%lf). Single runs are about %lf off it.",
                  &first, &now, &level, &low, &high, &noise) == 6);
  CHECK(std::abs(first - fit->at(0.0)) <= 0.05);
  CHECK(std::abs(now - fit->at(11.0)) <= 0.05);
  CHECK(std::abs(level - fit->level.value) <= 0.05);
  CHECK(std::abs(low - (fit->level.value - 2.0 * fit->level.deviation)) <= 0.05);
  CHECK(std::abs(high - (fit->level.value + 2.0 * fit->level.deviation)) <= 0.05);
  CHECK(std::abs(noise - fit->noise) <= 0.05);
  CHECK(level == doctest::Approx(8.0).epsilon(0.02));
  const auto rows = table_of(page, "tasks");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0] == std::vector<std::string>{"The drill", "12", "8", "3.1", "7.7", "7.6", "7.6"});
}

TEST_CASE("without a curve the page says why") {
  CHECK(has(page_of(learner(3)), "No trend yet: 5 graded runs needed, 3 so far."));
  CHECK(has(page_of(learner(4)), "No trend yet: 5 graded runs needed, 4 so far."));
  LearnerHistory flat = learner(8);
  for (RunRow& run : flat.runs) run.result.grade = 7.0;
  CHECK(has(page_of(flat), "All 8 grades are 7.0."));
  flat.runs[3].result.grade = 9.0;
  CHECK(has(page_of(flat), "No clear trend: the 8 grades vary between 7.0 and 9.0."));
}

TEST_CASE("grades that still rise towards the best one are called so: the unbounded fit would lead beyond it") {
  LearnerHistory history = learner(12);
  std::vector<double> grades;
  for (int i = 0; i < 12; ++i) {
    grades.push_back(std::min(10.0, 11.0 - 8.0 * std::exp(-i / 8.0) + (i % 2 == 0 ? 0.2 : -0.2)));
    history.runs[static_cast<std::size_t>(i)].result.grade = grades.back();
  }
  const auto free = fit_learning_curve(grades), held = fit_learning_curve(grades, {0.0, 10.0});
  REQUIRE(free.has_value());
  REQUIRE(held.has_value());
  REQUIRE(free->level.value > 10.0);
  const std::string caption =
      without_markup(between(section_of(page_of(history), "learning"), "<figcaption>", "</figcaption>"));
  double first = 0.0, now = 0.0;
  char rest[64] = {};
  REQUIRE(std::sscanf(caption.c_str(),
                      "The typical grade rose from %lf to %lf in 12 runs and is still changing, %20[a-z 0-9]", &first,
                      &now, rest) == 3);
  CHECK(rest == std::string("towards 10"));
  CHECK(std::abs(first - held->at(0.0)) <= 0.05);
  CHECK(std::abs(now - held->at(11.0)) <= 0.05);
}

// The sentence describes falling grades, and grades that no longer change.
TEST_CASE("falling grades and grades that have settled are described as such") {
  LearnerHistory history = learner(20);
  for (std::size_t i = 0; i < 20; ++i)
    history.runs[i].result.grade = 4.0 + 5.0 * std::exp(-static_cast<double>(i) / 2.0) + (i % 2 == 0 ? 0.05 : -0.05);
  const std::string page = page_of(history);
  CHECK(has(page, "The typical grade fell from 9.0 to 4.0 in 20 runs and stays near 4.0 (most likely "));
}

TEST_CASE("what the learner can do: one row per task, with status, reason and advice") {
  LearnerHistory history = learner(3);  // graded 3.1, 4.0 and 5.1: none passed
  const auto standing = [&] { return table_of(section_of(page_of(history), "standing"), "standings"); };
  CHECK(standing() == std::vector<std::vector<std::string>>{
                          {"The drill", "not yet", "Not passed in 3 graded attempts; the last, on 2026-01-04, got 5.1.",
                           "Drive it again."},
                          {"Reverse", "not tried", "", ""}});
  history.runs[2].result.errors = {make_driving_error(ErrorKind::jerk, Severity::minor, 1.0, 1.0),
                                   make_driving_error(ErrorKind::stall, Severity::severe, 1.0, 1.0)};
  CHECK(standing()[0][3] == "Stall: " + std::string(error_advice(ErrorKind::stall)));
  history.runs.push_back(run_with(4, 1, 9.0));
  history.runs.push_back(run_with(5, 1, 9.5));
  history.runs[4].begun_at = history.runs[3].begun_at;
  history.runs[4].result.guided = true;
  CHECK(standing()[0][1] == "nearly");
  CHECK(standing()[0][2] == "Passed once, but not yet again on another day or after another lesson; also 1 guided.");
  history.runs.push_back(run_with(6, 1, 9.5));
  CHECK(standing()[0][1] == "can");
  CHECK(standing()[0][2] == "Passed 2 of 5 graded attempts; the last, on 2026-01-07, got 9.5; also 1 guided.");
  CHECK(standing()[0][3].empty());
  for (int i = 7; i < 9; ++i) history.runs.push_back(run_with(i, 1, 2.0));
  CHECK(standing()[0][1] == "nearly");
  CHECK(standing()[0][2] == "Passed 2 of 7 graded attempts, but not the last one; also 1 guided.");
  history.runs.push_back(run_with(9, 1, 2.0));
  CHECK(standing()[0][1] == "not yet");
  CHECK(standing()[0][2] == "Passed 2 times, but in none of the latest attempts; also 1 guided.");
}

TEST_CASE("tasks with fewer than three graded runs are listed in one row and have no chart") {
  LearnerHistory history = learner(3);
  const auto add = [&](const char* task, double grade) {
    history.runs.push_back(run_with(static_cast<std::int64_t>(history.runs.size()) + 1, 1, grade));
    history.runs.back().result.task = task;
  };
  add("reverse", 8.0);
  add("hill_start", 4.5);
  add("reverse", 8.5);
  const std::string page = page_of(history);
  const std::string_view learning = section_of(page, "learning");
  const auto charts = [](std::string_view html) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = html.find("<figure class=\"curve\">", at)) != std::string_view::npos; ++at) ++count;
    return count;
  };
  CHECK(charts(learning) == 1);
  CHECK(table_of(learning, "tasks").size() == 3);  // all three tasks are in the table
  const auto few = table_of(learning, "few");
  REQUIRE(few.size() == 1);
  REQUIRE(few[0].size() == 1);
  CHECK(has(few[0][0], "Reverse: 8.0 ( Run 4 ), 8.5 ( Run 6 )"));
  CHECK(has(few[0][0], "Hill start: 4.5 ( Run 5 )"));
  CHECK_FALSE(has(few[0][0], "Upshift"));
  CHECK(has(learning, "Fewer than 3 graded runs"));
  add("reverse", 9.0);  // "reverse" now has three graded runs
  const std::string later = page_of(history);
  CHECK(charts(section_of(later, "learning")) == 2);
  CHECK_FALSE(has(table_of(later, "few")[0][0], "Reverse"));
  // If every task has too few runs, the page has no chart, and no text that explains charts.
  const std::string first = page_of(learner(1));
  CHECK(charts(first) == 0);
  CHECK_FALSE(has(first, "A dot is a graded run"));
  CHECK_FALSE(has(page_of(learner(3)), "<table class=\"few\">"));
}

TEST_CASE("the class page: each learner's tasks and next lesson, and how many can do each task") {
  std::vector<LearnerHistory> learners{learner(2), learner(3), {}};
  learners[0].learner = {1, "Ada <i>", "", ""};
  learners[1].learner = {2, "Bo", "", "reverse"};
  learners[2].learner = {3, "Cy", "", ""};
  for (RunRow& run : learners[0].runs) run.result.passed = true;
  const std::string page = class_page(learners, two_lessons());
  const auto rows = table_of(section_of(page, "learners"), "class");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == std::vector<std::string>{"Ada <i>", "2026-01-03", "2", "1", "0", "0", "1", "Reverse"});
  CHECK(rows[1] == std::vector<std::string>{"Bo", "2026-01-04", "3", "0", "0", "1", "1", "Reverse"});
  CHECK(rows[2] == std::vector<std::string>{"Cy", "–", "0", "0", "0", "0", "2", "The drill"});
  const auto tasks = table_of(section_of(page, "tasks"), "class");
  REQUIRE(tasks.size() == 2);
  CHECK(tasks[0] == std::vector<std::string>{"The drill", "1", "0", "1", "1", "Bo"});
  CHECK(tasks[1] == std::vector<std::string>{"Reverse", "0", "0", "0", "3", ""});
  const std::string each = without_markup(section_of(page, "each"));
  CHECK(has(each, "Next lesson:  Reverse . Chosen by the instructor."));
  CHECK(has(each, "Not passed in 3 graded attempts; the last, on 2026-01-04, got 5.1."));
  CHECK(has(each, "Can: The drill."));
  CHECK(has(each, "Not tried: The drill, Reverse."));
  // With a curve, its sentence is the same as in the learner's report.
  learners[1] = learner(12);
  learners[1].learner = {2, "Bo", "", ""};
  for (RunRow& run : learners[1].runs) run.result.passed = false;
  const std::string caption = without_markup(between(page_of(learners[1]), "<figcaption>", "</figcaption>"));
  REQUIRE(caption.starts_with("The typical grade rose"));
  CHECK(has(class_page(learners, two_lessons()), caption));
  CHECK(has(class_page({}, two_lessons()), "No learners yet."));
}

TEST_CASE("a step that took too long is named in the lists of runs and weaknesses") {
  LearnerHistory history = learner(2);
  const auto slow = [](const char* step, double seconds) {
    DrivingError error = make_driving_error(ErrorKind::slow_step, Severity::severe, 9.0, seconds);
    error.step = step;
    error.time_limit = 0.8;
    return error;
  };
  history.runs[0].result.errors = {slow("Start the engine.", 1.2)};
  history.runs[1].result.errors = {slow("Brake <hard>.", 1.78)};
  const std::string page = page_of(history);
  CHECK(has(table_of(page, "runs")[1][6], "You took 1.20 s for this step (limit 0.80 s): \"Start the engine.\""));
  CHECK(has(table_of(page, "runs")[0][6], "You took 1.78 s for this step (limit 0.80 s): \"Brake <hard>.\""));
  const auto weak = table_of(page, "weaknesses");
  REQUIRE(weak.size() == 1);
  CHECK(has(weak[0][0], "Slow step"));
  // The table shows the newest error of each kind.
  CHECK(has(weak[0][0], "You took 1.78 s for this step (limit 0.80 s): \"Brake <hard>.\""));
}

TEST_CASE("an error of any kind has its name and its sentence on the page") {
  LearnerHistory history = learner(1);
  std::vector<DrivingError>& errors = history.runs[0].result.errors;
  for (int i = 0; i < kErrorKindCount; ++i)
    errors.push_back(make_driving_error(static_cast<ErrorKind>(i), Severity::minor, 1.0, 3.0));
  const std::string page = page_of(history);
  const auto weak = table_of(page, "weaknesses");
  REQUIRE(weak.size() == kErrorKindCount);
  std::string names;
  for (const auto& row : weak) names += "|" + row[0];
  for (const DrivingError& error : errors) {
    const std::string advice(error_advice(error.kind));
    CHECK_FALSE(advice.empty());
    CHECK(has(names, "|" + title_from_key(to_string(error.kind)) + "  " + advice));
    CHECK(has(table_of(page, "runs")[0][6], error_sentence(error)));
  }
}

TEST_CASE("the advice for a kind of error appears once, with the run, if the kind cost points") {
  LearnerHistory history = learner(1);
  LessonResult& result = history.runs[0].result;
  result.errors = {make_driving_error(ErrorKind::grind, Severity::note, 1.0, 1.0, 0),
                   make_driving_error(ErrorKind::grind, Severity::minor, 2.0, 1.0, 0),
                   make_driving_error(ErrorKind::grind, Severity::minor, 3.0, 1.0, 0),
                   make_driving_error(ErrorKind::jerk, Severity::note, 4.0, 9.0, 0)};
  result.errors[1].points = 0.5;
  result.errors[2].points = 0.5;
  const std::string cell = table_of(page_of(history), "runs")[0][6];
  const std::string grind(error_advice(ErrorKind::grind));
  const std::size_t at = cell.find(grind);
  REQUIRE(at != std::string::npos);
  CHECK(cell.find("(2.0 s into the run, shift 1)") < at);
  CHECK(cell.find("(3.0 s into the run, shift 1)") > at);
  CHECK(cell.find(grind, at + 1) == std::string::npos);
  CHECK_FALSE(has(cell, error_advice(ErrorKind::jerk)));
}

// A developer has checked in a browser how these rules are rendered. This test only ensures that the rules stay in the
// style sheet.
TEST_CASE("the style breaks long words, and does not break a printed shift") {
  const std::string page = page_of(learner(1));
  const std::string_view style = between(page, "<style>", "</style>");
  CHECK(has(style, "body { overflow-wrap: anywhere; }"));
  const std::string_view print = style.substr(style.rfind("@media print"));
  const std::size_t avoid = print.find("{ break-inside: avoid; }");
  REQUIRE(avoid != std::string_view::npos);
  CHECK(has(print.substr(0, avoid), ".recording,"));
}

TEST_CASE("the counts, points and rates of weaknesses match the rows") {
  LearnerHistory history = learner(4);  // 4 runs with 4 shifts each: 16 shifts
  LessonResult& result = history.runs[0].result;
  result.errors = {make_driving_error(ErrorKind::grind, Severity::minor, 1.0, 1.0, 0),
                   make_driving_error(ErrorKind::grind, Severity::severe, 1.0, 1.0, 1)};
  result.errors[0].points = 0.5;
  result.errors[1].points = 2.0;
  const auto rows = table_of(page_of(history), "weaknesses");
  REQUIRE(rows.size() == 1);
  CHECK(std::vector<std::string>(rows[0].begin(), rows[0].begin() + 7) ==
        std::vector<std::string>{"Grind  " + std::string(error_advice(ErrorKind::grind)), "", "1", "1", "", "2.5",
                                 "1.2"});              // two errors in 16 shifts: 1.25 per ten shifts, shown as 1.2
  CHECK(rows[0][7].find("5.0") != std::string::npos);  // earlier half: one of 2 runs, 5.0 per ten runs
  CHECK(rows[0][8] == "none in the last 3 runs");
}

TEST_CASE("the worst shifts by points and the best by time, with figures that match the records") {
  LearnerHistory history = learner(3);
  LessonResult& bad = history.runs[1].result;
  bad.shifts[2].clutch_lag = -0.12;
  bad.shifts[2].force_peak = 71.5;
  bad.errors = {make_driving_error(ErrorKind::over_push, Severity::minor, 14.0, 71.5, 1),
                make_driving_error(ErrorKind::clutch_early, Severity::severe, 18.0, 0.12, 2)};
  bad.errors[0].points = 0.5;
  bad.errors[1].points = 2.0;
  history.runs[2].result.shifts[3].end -= 0.2;
  history.runs[1].result.shifts[2].impulse = 12.34;
  const std::string page = page_of(history);
  const std::string_view shifts = section_of(page, "shifts");
  const auto worst = table_of(shifts, "shifts");
  REQUIRE(worst.size() == 2);
  CHECK(worst[0][0] == "Run 2 , shift 3");
  CHECK(worst[0][1] == "2 → 3");
  CHECK(worst[0][3] == "2.0");
  CHECK(worst[0][4] == "0.10");
  CHECK(worst[0][5] == "−0.12");
  CHECK(worst[0][6] == "0.45");
  CHECK(worst[0][7] == "850");
  CHECK(worst[0][9] == "71.5");
  CHECK(worst[0][10] == "12.3");
  CHECK(worst[1][0] == "Run 2 , shift 2");
  const auto best = table_of(shifts.substr(shifts.find("Best shifts")), "shifts");
  REQUIRE(best.size() == 3);
  CHECK(best[0][0] == "Run 3 , shift 4");
}

TEST_CASE("retention: grades before and after a day and a week, marked at the run and with a ring around its dot") {
  LearnerHistory history = learner(4);
  const char* times[] = {"2026-03-01T10:00:00Z", "2026-03-01T10:20:00Z", "2026-03-02T10:20:00Z",
                         "2026-03-12T10:20:00Z"};
  const double grades[] = {4.0, 6.5, 6.2, 7.0};
  for (std::size_t i = 0; i < 4; ++i) {
    history.runs[i].begun_at = times[i];
    history.runs[i].result.grade = grades[i];
  }
  const std::string page = page_of(history);
  const std::string_view learning = section_of(page, "learning");
  const auto retention = table_of(learning, "kept");
  REQUIRE(retention.size() == 1);
  CHECK(retention[0] ==
        std::vector<std::string>{"The drill", "6.5", "6.2", "Run 3 , 24 hours", "6.2", "7.0", "Run 4 , 10 days"});
  const auto runs = table_of(page, "runs");
  CHECK(has(runs[0][2], "after a break of 10 days"));
  CHECK(has(runs[1][2], "after a break of 24 hours"));
  CHECK_FALSE(has(runs[2][2], "pause"));
  std::size_t rings = 0;
  for (std::size_t at = 0; (at = learning.find("<circle", at)) != std::string_view::npos; ++at)
    if (has(learning.substr(at, learning.find('>', at) - at), "r=\"7.00\" fill=\"none\"")) ++rings;
  CHECK(rings == 2);
  CHECK(has(learning, "Run 4, 2026-03-12: 7.0, after 10 days"));

  history.runs[0].result.guided = history.runs[1].result.guided = true;
  const std::string unknown = page_of(history);
  CHECK(table_of(section_of(unknown, "learning"), "kept")[0][1] == "–");

  for (RunRow& run : history.runs) run.begun_at = times[0];
  CHECK(has(page_of(history), "No lesson has been repeated after a day's break yet."));
  CHECK_FALSE(has(page_of(history), "<table class=\"kept\">"));
}

TEST_CASE("names, comments and reasons that contain markup are shown as text: the page's tags do not change") {
  LearnerHistory plain = learner(3), hostile = learner(3);
  const std::string attack = "</title><script>alert(1)</script>\"'><img src=x onerror=alert(1)>&lt;b&gt;<!--";
  const auto fill = [](LearnerHistory& history, const std::string& text) {
    history.learner.name = text;
    history.learner.next_lesson = text;
    LessonResult& result = history.runs[1].result;
    result.lesson = text;
    result.task = text;
    result.why = text;
    result.passed = false;
    history.runs[1].recording = text;
    history.runs[2].begun_at = text;
    result.errors = {make_driving_error(ErrorKind::stall, Severity::minor, 1.0, 1.0, 0)};
    history.runs[1].comments = {{text, text, text}};
  };
  fill(plain, "word");
  fill(hostile, attack);
  const std::string page = page_of(hostile);
  CHECK(tags_of(page) == tags_of(page_of(plain)));
  const auto rows = table_of(page, "runs");
  CHECK(has(rows[1][6], attack));  // the page shows the markup in `attack` as text
  CHECK(has(rows[1][5], attack));
}

TEST_CASE("a page is complete: every opened tag is closed, nothing is fetched, and no script runs") {
  for (const int runs : {0, 1, 30}) {
    const std::string page = page_of(learner(runs));
    std::vector<std::string> open;
    const std::set<std::string> single{"!DOCTYPE", "meta", "br", "rect", "line", "circle", "polygon", "polyline"};
    for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos; ++at) {
      const std::size_t end = page.find('>', at);
      const std::string tag = page.substr(at + 1, page.find_first_of(" >\n", at) - at - 1);
      if (page[end - 1] == '/' || (single.contains(tag) && tag != "circle")) continue;
      if (tag[0] != '/') {
        open.push_back(tag);
        continue;
      }
      REQUIRE(!open.empty());
      CHECK(open.back() == tag.substr(1));
      open.pop_back();
    }
    CHECK(open.empty());
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, " src="));
    CHECK_FALSE(has(page, "url("));
    CHECK_FALSE(has(page, "nan"));
    CHECK_FALSE(has(page, "inf"));
  }
}

TEST_CASE("the page of an empty history says that it is empty") {
  const std::string page = page_of(learner(0));
  CHECK(has(page, "No lessons driven yet."));
  CHECK(has(page, "No graded runs yet."));
  CHECK(has(page, "No driving errors in graded shifts."));
  CHECK(has(page, "Next lesson: <strong>The drill</strong>. You haven't passed The drill yet."));
  CHECK(text_of_id(page, "minutes") == "0.0");
}

TEST_CASE("500 runs are all listed") {
  const LearnerHistory history = learner(500);
  const std::string page = page_of(history);
  const auto rows = table_of(page, "runs");
  REQUIRE(rows.size() == 500);
  CHECK(rows[0][0] == "500");
  CHECK(rows[499][0] == "1");
  CHECK(text_of_id(page, "minutes") == "500.0");
  CHECK(dots_of(section_of(page, "learning")).size() == 500);
  CHECK(page.size() < 2'000'000);
}
