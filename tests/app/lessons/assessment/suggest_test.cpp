// Tests which lesson is suggested next: one never passed, else one that became weak, else one passed only once, else the
// lesson with the lowest grades.
#include "app/lessons/assessment/suggest.h"

#include <string>
#include <vector>

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

namespace {

constexpr std::int64_t kDay = 24 * 3600, kFirstDay = 20'000 * kDay;  // [s] since 1970

// Trials on a day, counted from kFirstDay, each with the break since the lesson's previous trial.
struct Diary {
  std::vector<GradedTrial> past;
  void drive(const char* lesson, std::int64_t day, double grade, const char* car = "hatchback", double path = 0.1) {
    GradedTrial trial = result(lesson, grade);
    trial.begun = kFirstDay + day * kDay + 36'000;
    trial.begun_at = std::to_string(1000 + day) + "-01-01";  // only compared
    for (const GradedTrial& before : past)
      if (before.lesson == lesson) trial.pause = static_cast<double>(*trial.begun - *before.begun);
    trial.car = car;
    trial.path_length = path;
    past.push_back(trial);
  }
  Suggestion on(std::int64_t day) const {
    return *suggest_lesson(three_lessons(), past, {}, kFirstDay + day * kDay + 40'000);
  }
};

bool says(const Suggestion& suggestion, const char* words) {
  return suggestion.why.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a week after a confirmed lesson was last driven, a retention test is due, once a day, longest break first") {
  Diary diary;
  diary.drive("start", 0, 9.0);
  diary.drive("start", 1, 9.0);
  diary.drive("bite", 2, 9.0);
  diary.drive("bite", 3, 9.0);
  CHECK(diary.on(4).lesson == "away");  // never passed; nothing is due yet
  CHECK(diary.on(7).lesson == "away");
  CHECK(diary.on(8).lesson == "start");
  CHECK(says(diary.on(8), "You last drove Start 7 days ago."));
  CHECK(diary.on(30).lesson == "start");  // both are due
  diary.drive("start", 30, 3.0);
  CHECK(diary.on(30).lesson == "away");  // one test a day, whatever its result
  CHECK(diary.on(31).lesson == "bite");
}

TEST_CASE("a lesson passed only once, or given up, is never due for a test; nor is anything without a date") {
  Diary diary;
  diary.drive("start", 0, 9.0);
  CHECK(diary.on(60).lesson == "bite");
  diary.drive("start", 1, 9.0);
  CHECK(diary.on(60).lesson == "start");
  CHECK(suggest_lesson(three_lessons(), diary.past, {})->lesson == "bite");
  for (GradedTrial& trial : diary.past) trial.begun.reset();
  CHECK(diary.on(60).lesson == "bite");
}

TEST_CASE(
    "a transfer test is due once a retention test was passed, until the lesson was driven with another car or gate") {
  for (const bool other_car : {true, false}) {
    CAPTURE(other_car);
    Diary diary;
    diary.drive("start", 0, 9.0);
    diary.drive("start", 1, 9.0);
    diary.drive("start", 10, 2.0);  // the retention test failed
    CHECK(diary.on(11).lesson == "bite");
    diary.drive("start", 12, 9.0);
    CHECK(diary.on(13).lesson == "bite");  // passed, but not after a week
    diary.drive("start", 20, 9.0);
    CHECK(diary.on(20).lesson == "bite");
    CHECK(diary.on(21).lesson == "start");
    CHECK(says(diary.on(21), "another car or gate"));
    diary.drive("start", 21, 9.0, other_car ? "diesel" : "hatchback", other_car ? 0.1 : 0.2);
    CHECK(diary.on(21).lesson == "bite");
    CHECK(diary.on(22).lesson == "bite");
  }
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
