// The next lesson: what has become weak, else what is new, else what is weakest.
#include "app/training/suggest.h"

#include <doctest/doctest.h>

using namespace gearshift;

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

PastResult result(const char* lesson, double grade) {
  return {lesson, lesson, grade, grade >= 6.0};
}

std::string next(const std::vector<PastResult>& past) {
  return suggest_lesson(three_lessons(), past)->lesson;
}

}  // namespace

TEST_CASE("a beginner begins, and goes on with the first lesson that was not passed") {
  CHECK(next({}) == "start");
  CHECK(next({result("start", 8.0)}) == "bite");
  CHECK(next({result("start", 4.0)}) == "start");
  CHECK(next({result("start", 8.0), result("bite", 3.0)}) == "bite");
  CHECK(next({result("bite", 9.0)}) == "start");
}

TEST_CASE("what has become weak comes before what is new, the weakest first") {
  const std::vector<PastResult> past{result("start", 8.0), result("bite", 9.0), result("bite", 2.0),
                                     result("bite", 3.0),  result("bite", 4.0), result("start", 3.0)};
  CHECK(next(past) == "bite");  // 3.0 against 5.5
  const auto suggestion = suggest_lesson(three_lessons(), past);
  CHECK(suggestion->why == "Bite point has become weak: 3.0 on average lately.");
}

TEST_CASE("with all passed the weakest is practised") {
  CHECK(next({result("start", 9.0), result("bite", 7.0), result("away", 8.0)}) == "bite");
}

TEST_CASE("only the last three results of a task count") {
  const std::vector<PastResult> past{result("start", 0.0), result("start", 6.0), result("bite", 1.0),
                                     result("start", 7.0), result("start", 8.0)};
  CHECK(task_grade(past, "start") == doctest::Approx(7.0));
  CHECK(task_grade(past, "bite") == doctest::Approx(1.0));
  CHECK_FALSE(task_grade(past, "away").has_value());
}

TEST_CASE("without lessons there is none to suggest") {
  CHECK_FALSE(suggest_lesson({}, {}).has_value());
}
