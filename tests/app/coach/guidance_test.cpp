// How much help a trial gets, over trials, programs and days.
#include <cmath>

#include <doctest/doctest.h>

#include "app/coach/planned_trial.h"
#include "tests/app/coach/coach_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

// By hand, from the policy's equations: g <- clamp(f g + k e, 0, 1), e = min(1, error / 0.4), f = 0.9 - 0.3 skill,
// k = 0.2, skill <- 0.7 skill + 0.3 (1 - e).
struct ByHand {
  double gain = 1.0, skill = 0.0;
  void learn(double error) {
    const double e = std::min(1.0, error / 0.4), forget = 0.9 - 0.3 * skill;
    gain = std::min(1.0, std::max(0.0, forget * gain + 0.2 * e));
    skill = 0.7 * skill + 0.3 * (1.0 - e);
  }
};

// Points of the faults over 10; 1 where it was not done.
double error_of(const LessonResult& result) {
  double points = 0.0;
  for (const DriveFault& fault : result.faults) {
    if (fault.severity == Severity::minor) points += 0.5;
    if (fault.severity == Severity::severe) points += 2.0;
    if (fault.severity == Severity::very_severe) points += 4.0;
  }
  return result.end == LessonEnd::done ? points / 10.0 : 1.0;
}

}  // namespace

TEST_CASE("trial n + 1 has the gain that the errors of n trials give, and half of the trials have none") {
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
    const LessonResult& result = coach.view().result;
    CHECK(result.guided == (gain > 0.0));
    if (result.guided) CHECK_FALSE(result.passed);
    CHECK((error_of(result) > 0.0) == (trial % 2 == 0));
    hand.learn(error_of(result));
  }
  CHECK(guided == 2);
  int graded = 0;
  for (const LessonStanding& each : coach.view().lessons) graded += each.trials;
  CHECK(graded == 2);  // guided trials are no grades
}

TEST_CASE("a new program goes on where the last one was; so does one without a history as long as it lives") {
  const TempFolder folder;
  const CoachBench remembered(folder / "history.db"), forgetful;
  Coach alone(forgetful.config);
  for (int trial = 0; trial < 10; ++trial) {
    Coach each(remembered.config);
    const Drive how = trial % 3 == 0 ? Drive::pushed : Drive::good;
    const LessonResult a = remembered.trial(each, "one", how), b = forgetful.trial(alone, "one", how);
    CHECK(each.view().guidance == alone.view().guidance);
    CHECK(each.view().hints == alone.view().hints);
    CHECK(a.guided == b.guided);
    CHECK(a.grade == b.grade);
  }
  Coach last(remembered.config);
  CHECK(last.view().lessons[0].trials == alone.view().lessons[0].trials);
  CHECK(last.view().lessons[0].grade == alone.view().lessons[0].grade);
  CHECK(last.view().runs.size() == 10);
  for (const RunRow& run : last.view().runs) CHECK_FALSE((run.result.guided && run.result.passed));
}

TEST_CASE("learners and lessons have their own order of guided trials") {
  std::vector<bool> orders[3];
  const std::pair<const char*, const char*> who[3] = {{"Ada", "one"}, {"Bob", "one"}, {"Ada", "two"}};
  for (int i = 0; i < 3; ++i) {
    std::vector<RunRow> runs;
    for (int trial = 0; trial < 40; ++trial) {
      orders[i].push_back(plan_trial(who[i].first, who[i].second, runs, kSomeDay).plan.guidance > 0.0);
      RunRow run;  // lost at once: an error of 1 keeps the gain up
      run.result.lesson = who[i].second;
      run.result.end = LessonEnd::aborted;
      run.begun_at = date_text(kSomeDay);
      runs.push_back(run);
    }
    CHECK(std::count(orders[i].begin(), orders[i].end(), true) == 20);
  }
  CHECK(orders[0] != orders[1]);
  CHECK(orders[0] != orders[2]);
}

TEST_CASE("who wants no help has none; what is said stays as planned") {
  const CoachBench bench;
  Coach coach(bench.config);
  Coach helped(bench.config);
  coach.want_help(false);
  for (int trial = 0; trial < 8; ++trial) {
    CHECK_FALSE(bench.trial(coach, "one").guided);
    bench.trial(helped, "one");
    CHECK(coach.view().hints == helped.view().hints);
  }
  CHECK(coach.view().lessons[0].trials == 8);
  CHECK(helped.view().lessons[0].trials < 8);
  // Wanted in the middle of a trial, it comes with the next one.
  coach.offer(bench.config.lessons[1]);
  bench.begin(coach);
  coach.want_help(true);
  CHECK(coach.guidance() == 0.0);
}

TEST_CASE("the first trial after 20 hours is a test: no help, nothing said on the way; the one after it is not") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  bench.now += 20 * 3600 - 1;
  coach.offer(bench.config.lessons[0]);
  CHECK_FALSE(coach.view().retention);
  bench.now += 1;
  coach.offer(bench.config.lessons[1]);
  CHECK_FALSE(coach.view().retention);  // never driven
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().retention);
  CHECK(coach.view().guidance == 0.0);
  CHECK(coach.view().hints == HintStyle::summary);

  Coach other(bench.config);  // another program knows it, too
  bench.begin(coach);
  CHECK(coach.view().retention);
  coach.add(bench_drive(Drive::pushed));
  CHECK_FALSE(coach.view().result.guided);
  other.offer(bench.config.lessons[0]);
  CHECK_FALSE(other.view().retention);
  bench.begin(coach);
  CHECK_FALSE(coach.view().retention);
  bench.now -= 360'000;  // a clock that was put back is no pause
  coach.offer(bench.config.lessons[0]);
  CHECK_FALSE(coach.view().retention);
}

TEST_CASE("a run that never ended, or was left, is no trial: neither pause nor policy know it") {
  for (const LessonEnd end : {LessonEnd::running, LessonEnd::left}) {
    RunRow run;
    run.result.lesson = "one";
    run.result.end = end;
    run.begun_at = date_text(kSomeDay);
    const std::vector<RunRow> none{run, run, run};
    for (const std::int64_t later : {0, 50 * 3600}) {
      const PlannedTrial plan = plan_trial("Ada", "one", none, kSomeDay + later);
      const PlannedTrial first = plan_trial("Ada", "one", {}, kSomeDay + later);
      CHECK_FALSE(plan.retention);
      CHECK(plan.plan.guidance == first.plan.guidance);
    }
  }
}

TEST_CASE("who passed and then left a trial is as far as before, and does the same trial again") {
  std::vector<RunRow> runs(4);
  for (RunRow& run : runs) {
    run.result.lesson = "one";
    run.result.end = LessonEnd::done;
    run.begun_at = date_text(kSomeDay);
  }
  const PlannedTrial before = plan_trial("Ada", "one", runs, kSomeDay);
  runs.push_back(runs.back());
  runs.back().result.end = LessonEnd::left;
  const PlannedTrial after = plan_trial("Ada", "one", runs, kSomeDay);
  CHECK(after.plan.guidance == before.plan.guidance);
  CHECK(after.plan.hints == before.plan.hints);
  CHECK(before.plan.hints != HintStyle::prescriptive);
}
