// Lessons run through the coach: phases, assessment, gaps in a drive, mode, standing and next lesson.
#include "app/lessons/coach/coach.h"

#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

const LessonStanding& standing(const Coach& coach, const std::string& lesson) {
  for (const LessonStanding& each : coach.view().lessons) {
    if (each.key == lesson) return each;
  }
  throw std::logic_error("no such lesson");
}

}  // namespace

TEST_CASE("a lesson goes through the phases offered, driving and over; cycles count only while driving") {
  const CoachBench bench;
  Coach coach(bench.config);
  CHECK(coach.view().phase == LessonPhase::none);
  CHECK(coach.lesson() == nullptr);
  CHECK_THROWS_AS(bench.begin(coach), std::logic_error);
  coach.add(bench_drive(Drive::good));
  coach.leave();
  CHECK(coach.view().phase == LessonPhase::none);

  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().phase == LessonPhase::offered);
  CHECK(coach.view().goal == "Shift to third.");
  coach.add(bench_drive(Drive::good));
  CHECK(coach.view().phase == LessonPhase::offered);
  CHECK(coach.guidance() == 0.0);

  bench.begin(coach);
  CHECK(coach.view().phase == LessonPhase::driving);
  CHECK(coach.view().now->prompt == "Clutch down.");
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach.add(std::span(drive).first(1500));  // third gear is engaged after 1500 samples
  CHECK(coach.view().now->prompt == "Clutch up.");
  CHECK(coach.guided_gear() == 3);
  coach.add(std::span(drive).subspan(1500));
  CHECK(coach.view().phase == LessonPhase::over);
  CHECK(coach.view().result->end == LessonEnd::done);
  CHECK(coach.guided_gear() == kNeutralGear);

  Lesson fast = bench.config.lessons[0];
  fast.goal = "Reach 100 km/h.";
  coach.offer(fast);
  coach.set_speed_unit(SpeedUnit::mph);
  CHECK(coach.view().goal == "Reach 62 mph.");
  coach.offer(fast);
  CHECK(coach.view().goal == "Reach 62 mph.");

  coach.dismiss_lesson();
  CHECK(coach.view().phase == LessonPhase::none);
  CHECK(coach.view().lesson.empty());
  CHECK(coach.lesson() == nullptr);
}

// The expected result comes from a LessonRun that gets the same samples without a coach.
TEST_CASE("a drive in batches of any size is assessed exactly as without a coach") {
  const CoachBench bench;
  std::mt19937 chance(3);
  for (const Drive how : {Drive::good, Drive::pushed}) {
    Coach coach(bench.config);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach);
    const std::vector<DriveSample> drive = bench_drive(how, coach.guidance());
    LessonRun single(bench.config.lessons[0], test_car(), known_gate(),
                     {coach.view().mode, coach.guidance(), coach.view().hints});
    for (const DriveSample& sample : drive) single.add(sample);
    for (std::size_t at = 0; at < drive.size();) {
      const std::size_t lot = std::min<std::size_t>(chance() % 50, drive.size() - at);
      coach.add(std::span(drive).subspan(at, lot));
      at += lot;
    }
    const LessonResult &mine = *coach.view().result, &expected = single.result();
    CHECK(mine.end == expected.end);
    CHECK(mine.why == expected.why);
    CHECK(mine.grade == expected.grade);
    CHECK(mine.passed == expected.passed);
    CHECK(mine.begin == expected.begin);
    CHECK(mine.duration == expected.duration);
    CHECK(mine.slip_energy == expected.slip_energy);
    REQUIRE(mine.errors.size() == expected.errors.size());
    for (std::size_t i = 0; i < mine.errors.size(); ++i) {
      CHECK(mine.errors[i].kind == expected.errors[i].kind);
      CHECK(mine.errors[i].time == expected.errors[i].time);
      CHECK(mine.errors[i].shift == expected.errors[i].shift);
    }
    REQUIRE(mine.shifts.size() == 1);
    CHECK(mine.shifts[0].path_length == expected.shifts[0].path_length);
    CHECK(mine.shifts[0].end == expected.shifts[0].end);
    CHECK(coach.view().now->feedback == single.view().feedback);
  }
}

TEST_CASE(
    "a drive with a gap, a repeated cycle or cycles from a different loop gets no grade; a gap before it is allowed") {
  const CoachBench bench;
  const auto driven = [&](const std::vector<DriveSample>& samples) {
    Coach coach(bench.config);
    coach.set_help(false);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach);
    coach.add(samples);
    return *coach.view().result;
  };
  for (const std::uint64_t from : {0u, 1u, 123456u}) {
    const LessonResult complete = driven(bench_drive(Drive::good, 0.0, from));
    CHECK(complete.is_complete);
    CHECK(complete.passed);
  }
  const auto torn = [&](const std::vector<DriveSample>& samples) {
    const LessonResult result = driven(samples);
    CHECK_FALSE(result.passed);
    CHECK(result.grade == 0.0);
    CHECK(result.end == LessonEnd::done);
    return !result.is_complete;
  };
  std::vector<DriveSample> hole = bench_drive(Drive::good);
  hole.erase(hole.begin() + 700);
  CHECK(torn(hole));
  std::vector<DriveSample> twice = bench_drive(Drive::good);
  twice.insert(twice.begin() + 700, twice[700]);
  CHECK(torn(twice));
  for (const std::uint64_t again : {0u, 1u}) {
    std::vector<DriveSample> other = bench_drive(Drive::good);
    for (std::size_t i = 700; i < other.size(); ++i) other[i].lever.cycle = i - 700 + again;
    CHECK(torn(other));
  }
  // A repeated cycle is invalid input. After the lesson's end, it does not change the result.
  std::vector<DriveSample> longer = bench_drive(Drive::good);
  longer.push_back(longer.back());
  CHECK(driven(longer).is_complete);
}

TEST_CASE("a trial without forces for 1 s during shifts or 3 s in total gets no grade; a ramp counts as forces") {
  const CoachBench bench;
  const auto driven = [&](GuardState state, double from, double to) {
    Coach coach(bench.config);
    coach.set_help(false);
    Lesson slower = bench.config.lessons[0];
    slower.steps.push_back(slower.steps.back());
    slower.steps.back().until.held = 5.0;
    coach.offer(slower);
    bench.begin(coach);
    std::vector<DriveSample> drive = bench_drive(Drive::good);
    for (DriveSample& sample : drive) sample.lever.time_ns *= 2;  // the drive takes twice as long
    const DriveSample last = drive.back();
    for (int i = 1; i < 8000; ++i) {  // the car continues to roll in gear
      drive.push_back(last);
      drive.back().lever.cycle += static_cast<std::uint64_t>(i);
      drive.back().lever.time_ns += std::int64_t{1'000'000} * i;
    }
    for (DriveSample& sample : drive) {
      if (sample.time() >= from && sample.time() < to) sample.lever.guard = state;
    }
    coach.add(drive);
    REQUIRE(coach.view().result->end == LessonEnd::done);
    REQUIRE(coach.view().result->shifts.size() == 1);
    REQUIRE(coach.view().result->shifts[0].end - coach.view().result->shifts[0].begin > 1.05);
    return *coach.view().result;
  };
  const LessonResult undisturbed = driven(GuardState::running, 0.0, 0.0);
  REQUIRE(undisturbed.passed);
  const double shift = undisturbed.shifts[0].begin, after = undisturbed.shifts[0].end;
  for (const GuardState off : {GuardState::idle, GuardState::armed, GuardState::damped, GuardState::released}) {
    CHECK(driven(off, shift, shift + 0.95).passed);
    CHECK(driven(off, after + 0.1, after + 3.0).passed);
    for (const LessonResult& none : {driven(off, shift, shift + 1.05), driven(off, after + 0.1, after + 3.2)}) {
      CHECK_FALSE(none.passed);
      CHECK_FALSE(none.is_complete);
      CHECK(none.grade == 0.0);
      CHECK(none.why == "Not graded: the lever's forces were off.");
    }
  }
  CHECK(driven(GuardState::ramping, 0.0, 1000.0).passed);
}

TEST_CASE(
    "a lesson is prompted step by step until it was passed, then driven without prompts, unless the user chooses") {
  const CoachBench bench;
  Coach coach(bench.config);
  coach.set_help(false);
  CHECK(bench.trial(coach, "one").mode == LessonMode::follow_me);
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().mode == LessonMode::by_yourself);
  coach.set_mode(LessonMode::follow_me);
  CHECK(bench.trial(coach, "one").mode == LessonMode::follow_me);
  // The user's choice of `follow_me` lasts until a different lesson is offered. Lesson "two" uses `follow_me` anyway,
  // because it was not passed yet.
  CHECK(bench.trial(coach, "one").mode == LessonMode::follow_me);
  CHECK(bench.trial(coach, "two").mode == LessonMode::follow_me);
  CHECK(bench.trial(coach, "one").mode == LessonMode::by_yourself);

  // A choice made during a trial takes effect in the next trial.
  bench.begin(coach);
  coach.set_mode(LessonMode::follow_me);
  coach.add(bench_drive(Drive::good));
  CHECK(coach.view().result->mode == LessonMode::by_yourself);
  bench.begin(coach);
  CHECK(coach.view().result->mode == LessonMode::follow_me);
}

TEST_CASE("the standing in a lesson: number of graded trials, the last grade, whether one was passed") {
  const CoachBench bench;
  Coach coach(bench.config);
  coach.set_help(false);
  CHECK(coach.view().next == "one");
  CHECK(standing(coach, "one").trials == 0);
  CHECK_FALSE(standing(coach, "one").grade.has_value());
  bench.trial(coach, "one");
  CHECK(standing(coach, "one").grade == 10.0);
  CHECK(standing(coach, "one").passed);
  CHECK(coach.view().next == "two");
  CHECK(coach.view().next_why == "You haven't passed Lesson two yet.");
  bench.trial(coach, "one", Drive::pushed);
  CHECK(standing(coach, "one").trials == 2);
  CHECK(*standing(coach, "one").grade < 10.0);
  CHECK(standing(coach, "one").best == 10.0);
  CHECK(standing(coach, "one").passed);
  CHECK(standing(coach, "two").trials == 0);
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().runs[0].result.grade == *standing(coach, "one").grade);  // the newest run comes first
}

TEST_CASE("a lesson is mastered by a second pass after another lesson or on another day, and the coach says so") {
  CoachBench bench;
  Coach coach(bench.config);
  coach.set_help(false);
  bench.trial(coach, "one");
  CHECK(coach.view().mastery == "Passed once. Pass it again tomorrow or after another lesson.");
  bench.trial(coach, "one");
  CHECK(standing(coach, "one").mastery == Mastery::passed_once);
  bench.now += 24 * 3600;
  bench.trial(coach, "one");
  CHECK(standing(coach, "one").mastery == Mastery::mastered);
  CHECK(coach.view().mastery == "Mastered: passed twice.");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().mastery.empty());
}

TEST_CASE("the standing counts guided and abandoned tries, too") {
  const CoachBench bench;
  Coach coach(bench.config);
  bench.trial(coach, "one");
  coach.offer(bench.config.lessons[0]);
  bench.begin(coach);
  std::vector<DriveSample> samples = bench_drive(Drive::good);
  samples.resize(50);
  coach.add(samples);
  coach.leave();
  CHECK(standing(coach, "one").tries == 2);
  CHECK(standing(coach, "one").trials <= 1);
}

TEST_CASE("a lesson that does not fit the gate is rejected, and the previous offer stays") {
  CoachBench bench;
  bench.config.lessons[0].steps[1].gear = 9;
  Coach coach(bench.config);
  coach.offer(bench.config.lessons[0]);
  CHECK_THROWS_AS(bench.begin(coach), std::invalid_argument);
  CHECK(coach.view().phase == LessonPhase::offered);
  coach.add(bench_drive(Drive::good));
  CHECK(coach.view().runs.empty());
}

TEST_CASE("after a restart the interrupted trial counts as left, and a new trial of the same lesson begins") {
  const CoachBench bench;
  Coach coach(bench.config);
  coach.offer(bench.config.lessons[0]);
  bench.begin(coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach.add(std::span(drive).first(100));
  bench.begin(coach);
  CHECK(coach.view().phase == LessonPhase::driving);
  REQUIRE(coach.view().runs.size() == 1);
  CHECK(coach.view().runs[0].result.end == LessonEnd::left);
  coach.offer(*coach.lesson());
  CHECK(coach.view().lesson == "one");
  CHECK(coach.view().runs.size() == 1);  // the second trial had no cycle, so it does not count as a run
}

TEST_CASE("a missing history is reported once, and lessons run without it") {
  CoachBench bench;
  bench.config.no_history = "no folder for the user's files";
  Coach coach(bench.config);
  CHECK(coach.take_problem() == "no folder for the user's files");
  CHECK_FALSE(coach.take_problem().has_value());
  coach.offer(bench.config.lessons.front());
  CHECK(coach.view().phase == LessonPhase::offered);
}

TEST_CASE("an invalid name is rejected; an empty name means no learner") {
  CoachBench bench;
  Coach coach(bench.config);
  for (const std::string& none : {std::string(101, 'x'), std::string("a\nb")})
    CHECK_THROWS_AS(coach.set_learner(none), std::invalid_argument);
  CHECK(coach.view().learner == "Ada");
  coach.set_learner("");
  CHECK(coach.view().learner.empty());
  CHECK(coach.view().learners.empty());
  CHECK_THROWS_AS(coach.set_next("three"), std::invalid_argument);
  CHECK_THROWS_AS(coach.add_comment(1, "Bo", "None."), std::invalid_argument);
}
