// When a lesson counts as mastered.
#include "app/lessons/assessment/mastery.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

GradedTrial trial(const char* lesson, bool passed, const char* begun_at) {
  GradedTrial trial;
  trial.lesson = trial.task = lesson;
  trial.passed = passed;
  trial.grade = passed ? 9.0 : 4.0;
  trial.begun_at = begun_at;
  return trial;
}

constexpr const char* kMorning = "2026-01-02T08:00:00Z";
constexpr const char* kNoon = "2026-01-02T12:00:00Z";
constexpr const char* kTomorrow = "2026-01-03T08:00:00Z";

}  // namespace

TEST_CASE("a lesson is mastered by a second pass on another day or after another lesson") {
  const GradedTrial first = trial("a", true, kMorning), again = trial("a", true, kNoon),
                    failed = trial("a", false, kNoon), next_day = trial("a", true, kTomorrow),
                    other = trial("b", false, kNoon);
  const auto mastery = [](const std::vector<GradedTrial>& past) { return mastery_of(past, "a"); };
  CHECK(mastery({}) == Mastery::not_passed);
  CHECK(mastery({failed, other}) == Mastery::not_passed);
  CHECK(mastery({first}) == Mastery::passed_once);
  CHECK(mastery({first, again, again}) == Mastery::passed_once);
  CHECK(mastery({first, failed, next_day}) == Mastery::mastered);
  CHECK(mastery({first, other, again}) == Mastery::mastered);
  CHECK(mastery({other, first, again}) == Mastery::passed_once);  // the other lesson came before the first pass
  CHECK(mastery({first, other, failed}) == Mastery::passed_once);
  CHECK(mastery({first, next_day, failed}) == Mastery::mastered);  // stays so; the suggestion looks at the last results
  CHECK(mastery_of(std::vector{first, again}, "b") == Mastery::not_passed);
  CHECK(mastery_sentence(Mastery::passed_once) == "Passed once. Pass it again tomorrow or after another lesson.");
}
