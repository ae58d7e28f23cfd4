// Tests which lesson is suggested next: one never passed, else one that became weak, else one passed only once, else the
// lesson with the lowest grades.
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
  return suggest_lesson(three_lessons(), past, {})->lesson;
}

// All three lessons were passed twice, in turns.
std::vector<GradedTrial> passed_all(double grade) {
  std::vector<GradedTrial> past;
  for (int i = 0; i < 6; ++i)
    past.push_back(result(three_lessons()[static_cast<std::size_t>(i % 3)].key.c_str(), grade));
  return past;
}

void add(std::vector<GradedTrial>& past, const char* lesson, const std::vector<double>& grades) {
  for (const double grade : grades) past.push_back(result(lesson, grade));
}

}  // namespace

TEST_CASE("a beginner starts with the first lesson, and continues with the first that was not passed") {
  CHECK(next({}) == "start");
  CHECK(next({result("start", 8.0)}) == "bite");
  CHECK(next({result("start", 4.0)}) == "start");
  CHECK(next({result("start", 8.0), result("bite", 3.0)}) == "bite");
  CHECK(next({result("bite", 9.0)}) == "start");
}

TEST_CASE("a lesson never passed comes before one that became weak, however often it was tried") {
  std::vector<GradedTrial> past{result("away", 9.0)};
  add(past, "away", {1.0, 1.0, 1.0});
  CHECK(next(past) == "start");
  add(past, "start", {8.0});
  for (int run = 0; run < 6; ++run) {
    CHECK(next(past) == "bite");
    add(past, "bite", {0.0});
  }
  CHECK(suggest_lesson(three_lessons(), past, {})->why == "You haven't passed Bite point yet (6 failed).");
  const std::vector<UngradedTrial> others{{"bite", false, true},
                                          {"bite", true, true},
                                          {"bite", true, false},
                                          {"bite", false, false},
                                          {"away", true, false}};
  CHECK(suggest_lesson(three_lessons(), past, others)->why ==
        "You haven't passed Bite point yet (6 failed, 1 guided, 2 given up, 1 cut off).");
  CHECK(suggest_lesson(three_lessons(), {}, {})->why == "You haven't passed Start yet.");
}

TEST_CASE(
    "of lessons that became weak, the one with the larger part of failed runs comes first, then the lower grade") {
  std::vector<GradedTrial> past = passed_all(8.0);
  add(past, "start", {2.0, 2.0});
  add(past, "bite", {3.0, 3.0, 3.0});
  CHECK(next(past) == "bite");
  CHECK(suggest_lesson(three_lessons(), past, {})->why ==
        "Bite point needs practice: 3 of the last 3 attempts failed, the latest one too (recent grade 3.0).");
  add(past, "start", {2.0});
  CHECK(next(past) == "start");
}

TEST_CASE("weak means that the newest run failed and at least half of the last three, at any grade") {
  const auto fails = [](std::vector<bool> passed) {  // newest last
    std::vector<GradedTrial> past = passed_all(8.0);
    for (const bool pass : passed) past.push_back({"away", "away", 9.5, pass});
    return suggest_lesson(three_lessons(), past, {})->why.starts_with("Moving off needs practice");
  };
  CHECK_FALSE(fails({true, false}));  // 8.0 passed, 9.5 passed, 9.5 failed
  CHECK(fails({false, false}));
  CHECK(fails({false, true, false}));
  CHECK_FALSE(fails({false, false, true}));
  CHECK_FALSE(fails({false, true, true}));
  CHECK(fails({false, false, false}));
}

TEST_CASE("a lesson passed once is repeated on another day or after another lesson, before the weakest") {
  const auto passed = [](const char* lesson, const char* day) {
    return GradedTrial{lesson, lesson, 9.0, true, 0, std::string(day) + "T10:00:00Z"};
  };
  std::vector<GradedTrial> past{passed("start", "2026-01-01"), passed("bite", "2026-01-01"),
                                passed("start", "2026-01-01"), passed("away", "2026-01-01")};
  CHECK(was_confirmed(past, "start"));  // after "bite"
  CHECK_FALSE(was_confirmed(past, "bite"));
  CHECK(suggest_lesson(three_lessons(), past, {})->why == "You have passed Bite point once; pass it again to be sure.");
  past.push_back(passed("bite", "2026-01-01"));
  past.push_back(passed("away", "2026-01-01"));
  CHECK(was_confirmed(past, "bite"));
  const std::vector<GradedTrial> same{passed("away", "2026-01-01"), passed("away", "2026-01-01")},
      later{passed("away", "2026-01-01"), passed("away", "2026-01-02")};
  CHECK_FALSE(was_confirmed(same, "away"));
  CHECK(was_confirmed(later, "away"));
  CHECK_FALSE(was_confirmed({}, "away"));
}

TEST_CASE("with all lessons passed twice the weakest is suggested") {
  std::vector<GradedTrial> past = passed_all(9.0);
  add(past, "bite", {7.0, 7.0});
  CHECK(next(past) == "bite");
  // (3 x 7 + 2 x 7 + 9) / 6
  CHECK(suggest_lesson(three_lessons(), past, {})->why ==
        "You have passed all lessons twice; Bite point is the weakest, with a recent grade of 7.3.");
}

TEST_CASE("of a task's last three results the newest weighs most") {
  const std::vector<GradedTrial> past{result("start", 0.0), result("start", 6.0), result("bite", 1.0),
                                      result("start", 7.0), result("start", 9.0)};
  CHECK(recent_results(past, "start")->grade == doctest::Approx((3 * 9.0 + 2 * 7.0 + 6.0) / 6.0));
  CHECK(recent_results(past, "bite")->grade == doctest::Approx(1.0));
  CHECK(recent_results(std::vector{result("away", 4.0), result("away", 9.0)}, "away")->grade ==
        doctest::Approx((3 * 9.0 + 2 * 4.0) / 5.0));
  CHECK_FALSE(recent_results(past, "away").has_value());
}

TEST_CASE("without lessons there is no suggestion") {
  CHECK_FALSE(suggest_lesson({}, {}, {}).has_value());
}
