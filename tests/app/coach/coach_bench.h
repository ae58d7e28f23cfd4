// A learner of a test's own: two small lessons, and a clock that is set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/coach/coach.h"
#include "tests/app/training/constructed_shift.h"

namespace gearshift {

inline constexpr std::int64_t kSomeDay = 1'800'000'000;  // [s] since 1970

// Third gear from second, as the constructed shift does it.
inline Lesson bench_lesson(const std::string& key) {
  Lesson lesson;
  lesson.key = lesson.task = key;
  lesson.title = "Lesson " + key;
  lesson.goal = "Shift to third.";
  lesson.time_limit = 20.0;
  lesson.catches = {FaultKind::stall};
  lesson.counts = {FaultKind::clutch_early, FaultKind::over_push, FaultKind::wrong_gear};
  DriveCondition down, in, up;
  down.clutch_above = 0.8;
  in.gear = up.gear = 3;
  up.clutch_below = 0.2;
  up.clutch_locked = true;
  lesson.steps = {{"Clutch down.", "All the way.", down, kNeutralGear, 2.0},
                  {"Lever to 3.", "Straight ahead.", in, 3, 2.0},
                  {"Clutch up.", "Slowly.", up, 3, 2.0}};
  return lesson;
}

enum class Drive { good, pushed };  // without a fault; with a push that is one

// Numbered as a loop numbers them, from some cycle on.
inline std::vector<DriveSample> bench_drive(Drive how, double guidance = 0.0, std::uint64_t from = 17) {
  ConstructedShift shift;
  if (how == Drive::pushed) {
    shift.spoil = [](DriveSample& s, double t) {
      if (t > 0.3 && t < 0.35) s.lever.f_h = {70.0, 0.0};
    };
  }
  std::vector<DriveSample> samples = shift.samples();
  for (DriveSample& sample : samples) {
    sample.lever.cycle = from++;
    sample.lever.guard = GuardState::running;
    sample.controls.guidance = guidance;
  }
  return samples;
}

struct CoachBench {
  std::int64_t now = kSomeDay;
  CoachConfig config;

  explicit CoachBench(const std::filesystem::path& history = {}, const std::string& learner = "Ada") {
    config.lessons = {bench_lesson("one"), bench_lesson("two")};
    config.history = history;
    config.learner = learner;
    config.program = "bench 1.0";
    config.now = [this] { return now; };
  }
  CoachBench(const CoachBench&) = delete;
  CoachBench& operator=(const CoachBench&) = delete;

  void begin(Coach& coach, const std::string& settings = "gate = paper", const std::string& recording = "") const {
    coach.begin(test_car(), known_gate(), settings, recording);
  }

  // A trial of the lesson, as a trainer drives it: guided as the coach says.
  LessonResult trial(Coach& coach, const std::string& lesson, Drive how = Drive::good) const {
    coach.offer(*std::find_if(config.lessons.begin(), config.lessons.end(),
                              [&](const Lesson& each) { return each.key == lesson; }));
    begin(coach);
    coach.add(bench_drive(how, coach.guidance()));
    return coach.view().result;
  }
};

}  // namespace gearshift
