// Tests which lesson is suggested next: a lesson whose results got worse, else a new lesson, else the lesson with the
// lowest grades.
#include "app/lessons/assessment/suggest.h"

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

std::vector<Lesson> three_lessons() {
  std::vector<Lesson> lessons(3);
  const char* keys[] = {"start", "bite", "away"};
  const char* titles[] = {"Start", "Bite point", "Moving off"};
  for (std::size_t i = 0; i < 3; ++i) {
    lessons[i].key = lessons[i].task = keys[i];
    lessons[i].title = titles[i];
  }
  return lessons;
}

GradedTrial result(const char* lesson, double grade) {
  return {lesson, lesson, grade, grade >= 6.0};
}

std::string next(const std::vector<GradedTrial>& past) {
  return suggest_lesson(three_lessons(), past)->lesson;
}

}  // namespace

TEST_CASE("a beginner starts with the first lesson, and continues with the first that was not passed") {
  CHECK(next({}) == "start");
  CHECK(next({result("start", 8.0)}) == "bite");
  CHECK(next({result("start", 4.0)}) == "start");
  CHECK(next({result("start", 8.0), result("bite", 3.0)}) == "bite");
  CHECK(next({result("bite", 9.0)}) == "start");
}

TEST_CASE("lessons with worse results come before new ones, the worst first") {
  const std::vector<GradedTrial> past{result("start", 8.0), result("bite", 9.0), result("bite", 2.0),
                                      result("bite", 3.0),  result("bite", 4.0), result("start", 3.0)};
  CHECK(next(past) == "bite");  // average of the last three grades: "bite" 3.0, "start" 5.5 (only two grades)
  const auto suggestion = suggest_lesson(three_lessons(), past);
  CHECK(suggestion->why == "Bite point needs practice: 3 of the last 3 attempts failed (average grade 3.0).");
}

TEST_CASE("worse means recently failed, at any grade: one error can fail a lesson at 9.5") {
  const GradedTrial failed{"away", "away", 9.5, false}, passed{"away", "away", 9.5, true};
  std::vector<GradedTrial> past{result("start", 8.0), passed, result("start", 6.0)};
  CHECK(next(past) == "bite");
  past.push_back(failed);
  CHECK(next(past) == "away");
  past.push_back(passed);
  CHECK(next(past) == "bite");  // "away" failed in only one of its last three runs, which is tolerated
  past.push_back(failed);
  CHECK(next(past) == "away");
}

TEST_CASE("more failures are worse; if equal, the lower grade is worse") {
  const auto runs = [](const char* lesson, const std::vector<double>& grades) {
    std::vector<GradedTrial> list{{lesson, lesson, 10.0, true}};
    for (const double grade : grades) list.push_back({lesson, lesson, grade, false});
    return list;
  };
  std::vector<GradedTrial> past = runs("start", {0.0}), more = runs("bite", {9.0, 9.0, 9.0});
  past.insert(past.end(), more.begin(), more.end());
  CHECK(next(past) == "bite");
  past = runs("start", {8.0, 8.0, 8.0});
  past.insert(past.end(), more.begin(), more.end());
  CHECK(next(past) == "start");
}

TEST_CASE("a lesson never passed in three runs also counts as worse; with one or two runs it is still new") {
  std::vector<GradedTrial> past{result("start", 8.0)};
  for (int run = 1; run <= 6; ++run) {
    past.push_back(result("away", 0.0));
    CHECK(next(past) == (run < 3 ? "bite" : "away"));
  }
}

TEST_CASE("with all lessons passed the weakest is suggested") {
  CHECK(next({result("start", 9.0), result("bite", 7.0), result("away", 8.0)}) == "bite");
}

TEST_CASE("only the last three results of a task count") {
  const std::vector<GradedTrial> past{result("start", 0.0), result("start", 6.0), result("bite", 1.0),
                                      result("start", 7.0), result("start", 8.0)};
  CHECK(task_grade(past, "start") == doctest::Approx(7.0));
  CHECK(task_grade(past, "bite") == doctest::Approx(1.0));
  CHECK_FALSE(task_grade(past, "away").has_value());
}

TEST_CASE("without lessons there is no suggestion") {
  CHECK_FALSE(suggest_lesson({}, {}).has_value());
}
