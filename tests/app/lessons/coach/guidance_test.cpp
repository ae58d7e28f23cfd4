// How strongly the coach guides trials, from trial to trial, across restarts of the program, and from day to day.
#include <cmath>

#include <doctest/doctest.h>

#include "app/lessons/coach/planned_trial.h"
#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

// The policy's equations, implemented independently, for the gain g, the scaled error e, the fade factor f and the
// skill s: e = min(1, error / 0.4), f = 0.9 - 0.3 s, g <- clamp(f g + 0.4 e, 0, 1), s <- 0.7 s + 0.3 (1 - e).
struct ByHand {
  double gain = 0.0, skill = 0.0;
  void learn(double error) {
    const double e = std::min(1.0, error / 0.4), forget = 0.9 - 0.3 * skill;
    gain = std::min(1.0, std::max(0.0, forget * gain + 0.4 * e));
    skill = 0.7 * skill + 0.3 * (1.0 - e);
  }
};

Lesson lesson_of(const char* key) {
  Lesson lesson;
  lesson.key = key;
  return lesson;
}

// [1] The points that errors cost, divided by 10; 1 for a lesson that was not finished.
double error_of(const LessonResult& result) {
  double points = 0.0;
  for (const DrivingError& error : result.errors) {
    if (error.severity == Severity::minor) points += 0.5;
    if (error.severity == Severity::severe) points += 2.0;
    if (error.severity == Severity::very_severe) points += 4.0;
  }
  return result.end == LessonEnd::done ? points / 10.0 : 1.0;
}

}  // namespace

TEST_CASE("the gain of trial n + 1 follows from the errors of n trials, and half of the trials are unguided") {
  const CoachBench bench;
  Coach coach(bench.config);
  ByHand hand;
  int guided = 0;
  for (int trial = 0; trial < 4; ++trial) {
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach);
    const double gain = coach.guidance();
    CHECK(gain == coach.view().guidance);
    if (gain > 0.0) CHECK(gain == doctest::Approx(hand.gain).epsilon(1e-12));
    guided += gain > 0.0 ? 1 : 0;
    coach.add(bench_drive(trial % 2 == 0 ? Drive::pushed : Drive::good, gain));
    const LessonResult& result = *coach.view().result;
    CHECK(result.guided == (gain > 0.0));
    if (result.guided) CHECK_FALSE(result.passed);
    CHECK((error_of(result) > 0.0) == (trial % 2 == 0));
    hand.learn(error_of(result));
  }
  CHECK(guided >= 1);  // of the first four trials two would be, but nothing failed before the first
  CHECK(guided <= 2);
  int graded = 0;
  for (const LessonStanding& each : coach.view().lessons) graded += each.trials;
  CHECK(graded == 4 - guided);  // guided trials get no grade
}

TEST_CASE(
    "a new program continues the sequence of trials from the history; without one it continues within the program") {
  const TempFolder folder;
  const CoachBench remembered(folder / "history.db"), forgetful;
  Coach without_history(forgetful.config);
  for (int trial = 0; trial < 10; ++trial) {
    Coach each(remembered.config);
    const Drive how = trial % 3 == 0 ? Drive::pushed : Drive::good;
    const LessonResult a = remembered.trial(each, "one", how), b = forgetful.trial(without_history, "one", how);
    CHECK(each.view().guidance == without_history.view().guidance);
    CHECK(each.view().hints == without_history.view().hints);
    CHECK(a.guided == b.guided);
    CHECK(a.grade == b.grade);
  }
  Coach last(remembered.config);
  CHECK(last.view().lessons[0].trials == without_history.view().lessons[0].trials);
  CHECK(last.view().lessons[0].grade == without_history.view().lessons[0].grade);
  CHECK(last.view().runs.size() == 10);
  for (const RunRow& run : last.view().runs) CHECK_FALSE((run.result.guided && run.result.passed));
}

TEST_CASE("each learner has a separate order of guided trials for each lesson") {
  std::vector<bool> orders[3];
  const std::pair<const char*, const char*> learner_and_lesson[3] = {{"Ada", "one"}, {"Bob", "one"}, {"Ada", "two"}};
  for (int i = 0; i < 3; ++i) {
    std::vector<RunRow> runs;
    for (int trial = 0; trial < 40; ++trial) {
      orders[i].push_back(
          plan_trial(learner_and_lesson[i].first, lesson_of(learner_and_lesson[i].second), runs, kSomeDay)
              .plan.guidance > 0.0);
      RunRow run;  // its errors of the lever keep the gain high
      run.result.errors = {make_driving_error(ErrorKind::wrong_gear, Severity::very_severe, 1.0, 4.0)};
      run.result.lesson = learner_and_lesson[i].second;
      run.result.end = LessonEnd::aborted;
      run.begun_at = format_utc(kSomeDay);
      runs.push_back(run);
    }
    CHECK(std::count(orders[i].begin(), orders[i].end(), true) >= 19);  // 20, if nothing had to fail before the first
  }
  CHECK(orders[0] != orders[1]);
  CHECK(orders[0] != orders[2]);
}

TEST_CASE("with help switched off no trial is guided, and the planned hints stay") {
  const CoachBench bench;
  Coach coach(bench.config);
  Coach helped(bench.config);
  coach.set_help(false);
  for (int trial = 0; trial < 8; ++trial) {
    CHECK_FALSE(bench.trial(coach, "one", Drive::pushed).guided);
    bench.trial(helped, "one", Drive::pushed);
    CHECK(coach.view().hints == helped.view().hints);
  }
  CHECK(coach.view().lessons[0].trials == 8);
  CHECK(helped.view().lessons[0].trials < 8);
  // A change made during a trial takes effect in the next trial.
  coach.offer(bench.config.lessons[1]);
  bench.begin(coach);
  coach.set_help(true);
  CHECK(coach.guidance() == 0.0);
}

TEST_CASE("the first trial after 20 hours is a test without guidance and hints; the next trial is not") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  bench.now += 20 * 3600 - 1;
  coach.offer(bench.config.lessons[0]);
  CHECK_FALSE(coach.view().retention);
  bench.now += 1;
  coach.offer(bench.config.lessons[1]);
  CHECK_FALSE(coach.view().retention);  // this lesson was never driven, so there is nothing to retain
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().retention);
  CHECK(coach.view().guidance == 0.0);
  CHECK(coach.view().hints == HintStyle::summary);

  Coach other(bench.config);  // a second program that uses the same history
  bench.begin(coach);
  CHECK(coach.view().retention);
  coach.add(bench_drive(Drive::pushed));
  CHECK_FALSE(coach.view().result->guided);
  other.offer(bench.config.lessons[0]);
  CHECK_FALSE(other.view().retention);
  bench.begin(coach);
  CHECK_FALSE(coach.view().retention);
  bench.now -= 360'000;  // setting the clock back does not create a break
  coach.offer(bench.config.lessons[0]);
  CHECK_FALSE(coach.view().retention);
}

TEST_CASE("a run that never ended or was left is not a trial, so it affects neither break nor policy") {
  for (const LessonEnd end : {LessonEnd::running, LessonEnd::left}) {
    RunRow run;
    run.result.lesson = "one";
    run.result.end = end;
    run.begun_at = format_utc(kSomeDay);
    const std::vector<RunRow> none{run, run, run};
    for (const std::int64_t later : {0, 50 * 3600}) {
      const PlannedTrial plan = plan_trial("Ada", lesson_of("one"), none, kSomeDay + later);
      const PlannedTrial first = plan_trial("Ada", lesson_of("one"), {}, kSomeDay + later);
      CHECK_FALSE(plan.retention);
      CHECK(plan.plan.guidance == first.plan.guidance);
    }
  }
}

TEST_CASE("after leaving a trial the learner repeats that trial, with the same guidance and hints") {
  std::vector<RunRow> runs(4);
  for (RunRow& run : runs) {
    run.result.lesson = "one";
    run.result.end = LessonEnd::done;
    run.begun_at = format_utc(kSomeDay);
  }
  const PlannedTrial before = plan_trial("Ada", lesson_of("one"), runs, kSomeDay);
  runs.push_back(runs.back());
  runs.back().result.end = LessonEnd::left;
  const PlannedTrial after = plan_trial("Ada", lesson_of("one"), runs, kSomeDay);
  CHECK(after.plan.guidance == before.plan.guidance);
  CHECK(after.plan.hints == before.plan.hints);
  CHECK(before.plan.hints != HintStyle::prescriptive);
}
