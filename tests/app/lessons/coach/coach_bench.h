// A coach for tests: its configuration with two short lessons, a learner, and a clock that the test sets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/lessons/coach/coach.h"
#include "tests/app/lessons/assessment/constructed_shift.h"

namespace gearshift::test {

inline constexpr std::int64_t kSomeDay = 1'800'000'000;  // [s] since 1970

// A lesson from second gear to third. Its steps match the shift that ConstructedShift makes.
inline lessons::Lesson bench_lesson(const std::string& key) {
  lessons::Lesson lesson;
  lesson.key = lesson.task = key;
  lesson.title = "Lesson " + key;
  lesson.goal = "Shift to third.";
  lesson.time_limit = 20.0;
  lesson.fails_on = {lessons::ErrorKind::stall};
  lesson.counted = {lessons::ErrorKind::clutch_early, lessons::ErrorKind::over_push, lessons::ErrorKind::wrong_gear};
  lessons::DriveCondition down, in, up;
  down.clutch_above = 0.8;
  in.gear = up.gear = 3;
  up.clutch_below = 0.2;
  up.clutch_locked = true;
  lesson.steps = {{"Clutch down.", "All the way.", down, haptics::kNeutralGear, 2.0},
                  {"Lever to 3.", "Straight ahead.", in, 3, 2.0},
                  {"Clutch up.", "Slowly.", up, 3, 2.0}};
  return lesson;
}

enum class Drive { good, pushed };  // `pushed` contains an over-push, which is a driving error

// The samples of one drive. Their cycle numbers start at `from` and have no gaps, as in a haptic loop.
inline std::vector<vehicle::DriveSample> bench_drive(Drive how, double guidance = 0.0, std::uint64_t from = 17) {
  ConstructedShift shift;
  if (how == Drive::pushed) {
    shift.modify = [](vehicle::DriveSample& s, double t) {
      if (t > 0.3 && t < 0.35) s.lever.f_h = {70.0, 0.0};
    };
  }
  std::vector<vehicle::DriveSample> samples = shift.samples();
  for (vehicle::DriveSample& sample : samples) {
    sample.lever.cycle = from++;
    sample.lever.guard = haptics::GuardState::running;
    sample.controls.guidance = guidance;
  }
  return samples;
}

struct CoachBench {
  std::int64_t now = kSomeDay;
  lessons::CoachConfig config;

  explicit CoachBench(const std::filesystem::path& history = {}, const std::string& learner = "Ada") {
    config.lessons = {bench_lesson("one"), bench_lesson("two")};
    config.history = history;
    config.learner = learner;
    config.program = "bench 1.0";
    config.now = [this] { return now; };
  }
  CoachBench(const CoachBench&) = delete;
  CoachBench& operator=(const CoachBench&) = delete;

  void begin(lessons::Coach& coach, const std::string& recording = "") const {
    coach.begin(test_car(), known_gate(), recording);
  }

  // Drives the lesson once as a session does. The trial is guided if the coach decides so.
  lessons::LessonResult trial(lessons::Coach& coach, const std::string& lesson, Drive how = Drive::good) const {
    coach.offer(*std::find_if(config.lessons.begin(), config.lessons.end(),
                              [&](const lessons::Lesson& each) { return each.key == lesson; }));
    begin(coach);
    coach.add(bench_drive(how, coach.guidance()));
    return *coach.view().result;
  }
};

}  // namespace gearshift::test
