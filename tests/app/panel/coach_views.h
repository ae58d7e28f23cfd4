// What a coach has to say at each point of a lesson, made by hand: the shipped lessons, a learner who is half through.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/coach/coach_view.h"
#include "app/training/grade.h"
#include "app/training/lesson.h"
#include "app/training/suggest.h"

namespace gearshift {

inline Lesson shipped_lesson(std::string_view key) {
  return read_lesson(GEARSHIFT_ASSETS "/lessons/" + std::string(key) + ".toml");
}

// A learner with a name, four lessons passed, a fifth one tried; hill_start is the next one. Nothing is offered.
inline CoachView half_way() {
  CoachView coach;
  coach.learner = "Ada Example";
  coach.learners = {"Ada Example", "Bert", "Charlotte van der Hoek"};
  coach.remembers = true;
  constexpr double kGrades[] = {9.5, 8.0, 10.0, 6.5, 3.5};
  for (const std::string_view key : kTeachingOrder) {
    const Lesson lesson = shipped_lesson(key);
    LessonStanding standing{lesson.key, lesson.title, lesson.task, 0, std::nullopt, false};
    if (const std::size_t i = coach.lessons.size(); i < std::size(kGrades)) {
      standing.trials = 2 * static_cast<int>(i) + 1;
      standing.grade = kGrades[i];
      standing.passed = kGrades[i] >= 6.0;
      standing.best = std::max(kGrades[i], i == 3 ? 9.0 : 0.0);
    }
    coach.lessons.push_back(standing);
  }
  coach.next = "hill_start";
  coach.next_why = "It is the first lesson that has not been passed yet.";
  return coach;
}

inline CoachView offered(std::string_view key = "hill_start") {
  CoachView coach = half_way();
  const Lesson lesson = shipped_lesson(key);
  coach.phase = LessonPhase::offered;
  coach.lesson = lesson.key;
  coach.title = lesson.title;
  coach.goal = lesson.goal;
  return coach;
}

// In its third step, two faults said.
inline CoachView driven(std::string_view key = "hill_start") {
  CoachView coach = offered(key);
  const Lesson lesson = shipped_lesson(key);
  coach.phase = LessonPhase::driving;
  coach.now.step = 2;
  coach.now.steps = lesson.steps.size();
  coach.now.prompt = lesson.steps[2].prompt;
  coach.now.hint = lesson.steps[2].hint;
  coach.now.said = {"The lever moved 0.12 s before the clutch was down.", "The engine stalled, from 640 rpm."};
  return coach;
}

inline ShiftRecord shift_of(std::int64_t number, int from, int to, double begin) {
  ShiftRecord shift;
  shift.number = number;
  shift.from = from;
  shift.to = to;
  shift.begin = begin;
  shift.end = begin + 0.84;
  shift.clutch_lag = 0.12;
  shift.rev_error = 25.0;
  return shift;
}

// Judged as a lesson run judges it.
inline LessonResult result_of(std::string_view key, std::vector<DriveFault> faults, bool guided = false) {
  LessonResult result;
  const Lesson lesson = shipped_lesson(key);
  result.lesson = lesson.key;
  result.task = lesson.task;
  result.end = LessonEnd::done;
  result.guided = guided;
  result.begin = 12.0;
  result.duration = 34.0;
  result.faults = std::move(faults);
  result.shifts = {shift_of(0, kNeutralGear, 1, 13.0), shift_of(1, 1, 2, 19.5)};
  result.shifts[1].block_time = 0.31;
  result.shifts[1].clutch_lag = -0.08;
  grade_result(lesson, result);
  return result;
}

inline std::vector<DriveFault> some_faults() {
  return {{FaultKind::jerk, Severity::minor, 14.2, 9.7, 0},
          {FaultKind::grind, Severity::severe, 19.9, 12.4, 1},
          {FaultKind::wrong_column, Severity::note, 20.1, 2.0, 1}};
}
inline std::vector<DriveFault> failing_faults() {
  std::vector<DriveFault> faults = some_faults();
  faults.push_back({FaultKind::stall, Severity::very_severe, 31.0, 62.0, -1});
  faults.push_back({FaultKind::throttle_in_shift, Severity::minor, 33.0, 80.0, 1});
  faults.push_back({FaultKind::rollback, Severity::severe, 36.5, 0.42, -1});
  faults.push_back({FaultKind::over_push, Severity::minor, 37.0, 48.0, -1});
  faults.push_back({FaultKind::clutch_dump, Severity::severe, 38.0, 32000.0, -1});
  return faults;
}

inline CoachView over(const LessonResult& result) {
  CoachView coach = driven(result.lesson);
  coach.phase = LessonPhase::over;
  coach.result = result;
  coach.guidance = result.guided ? 0.8 : 0.0;
  coach.next = result.passed ? "emergency_stop" : "hill_start";
  return coach;
}

// Six runs, the newest first: passed and recorded, failed, guided, left, cut off, lost in part. With a comment.
inline CoachView with_history() {
  CoachView coach = half_way();
  const auto add = [&](std::int64_t id, const char* at, LessonResult result, const char* recording) {
    coach.runs.push_back({id, 1, at, recording, std::move(result)});
    coach.comments.emplace_back();
  };
  LessonResult left = result_of("reverse", {}), cut = left, lost = left;
  left.end = LessonEnd::left;
  left.passed = false;
  left.why = "The lesson was left.";
  cut.end = LessonEnd::running;
  lost.whole = false;
  add(16, "2026-01-02T10:31:00Z", result_of("hill_start", some_faults()), "/tmp/hill.trace");
  add(15, "2026-01-02T10:20:00Z", result_of("hill_start", failing_faults()), "");
  add(14, "2026-01-02T10:11:00Z", result_of("down_through_the_gears", some_faults(), true), "/tmp/down.trace");
  add(13, "2026-01-01T09:11:00Z", left, "");
  add(12, "2026-01-01T09:05:00Z", cut, "");
  add(11, "2026-01-01T09:00:00Z", lost, "");
  coach.comments[0] = {{"2026-01-02T11:00:00Z", "Ms Torque", "Wait for the synchroniser: push, do not hit."}};
  return coach;
}

}  // namespace gearshift
