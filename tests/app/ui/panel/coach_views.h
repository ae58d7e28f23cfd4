// Hand-written states of the coach for each phase of a lesson. They contain the shipped lessons and a learner who has
// passed some of them.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/suggest.h"
#include "app/lessons/coach/coach_view.h"

namespace gearshift::test {

inline const lessons::Lesson& shipped_lesson(std::string_view key) {  // each is read once
  static std::map<std::string, lessons::Lesson, std::less<>> read;
  const auto known = read.find(key);
  if (known != read.end()) return known->second;
  const std::string name(key);
  return read.emplace(name, lessons::read_lesson(GEARSHIFT_ASSETS "/lessons/" + name + ".toml")).first->second;
}

// A CoachView with a trial of its own. view() is valid while this object is neither moved nor changed.
struct CoachState : lessons::CoachView {
  lessons::LessonView now;
  lessons::LessonResult result;

  const lessons::CoachView& view() {
    CoachView::now = &now;
    CoachView::result = &result;
    return *this;
  }
};

// A named learner who has passed four lessons and tried a fifth. The suggested lesson is `hill_start`. No lesson is
// offered.
inline CoachState half_way() {
  CoachState coach;
  coach.learner = "Ada Example";
  coach.learners = {"Ada Example", "Bert", "Charlotte van der Hoek"};
  coach.is_saving = true;
  constexpr double kGrades[] = {9.5, 8.0, 10.0, 6.5, 3.5};
  for (const std::string_view key : lessons::kTeachingOrder) {
    const lessons::Lesson lesson = shipped_lesson(key);
    lessons::LessonStanding standing{lesson.key, lesson.title, lesson.task, 0, std::nullopt, false};
    if (const std::size_t i = coach.lessons.size(); i < std::size(kGrades)) {
      standing.trials = 2 * static_cast<int>(i) + 1;
      standing.grade = kGrades[i];
      standing.passed = kGrades[i] >= 6.0;
      standing.tries = standing.trials + 1;
      if (standing.passed) standing.mastery = i < 2 ? lessons::Mastery::mastered : lessons::Mastery::passed_once;
      standing.best = std::max(kGrades[i], i == 3 ? 9.0 : 0.0);
    }
    coach.lessons.push_back(standing);
  }
  coach.next = "hill_start";
  coach.next_why = "It is the first lesson that has not been passed yet.";
  return coach;
}

inline CoachState offered(std::string_view key = "hill_start") {
  CoachState coach = half_way();
  const lessons::Lesson lesson = shipped_lesson(key);
  coach.phase = lessons::LessonPhase::offered;
  coach.lesson = lesson.key;
  coach.title = lesson.title;
  coach.goal = lesson.goal;
  return coach;
}

// A lesson in its third step (its last if it has two), with two errors so far.
inline CoachState driven(std::string_view key = "hill_start") {
  CoachState coach = offered(key);
  const lessons::Lesson lesson = shipped_lesson(key);
  coach.phase = lessons::LessonPhase::driving;
  coach.now.step = std::min<std::size_t>(2, lesson.steps.size() - 1);
  coach.now.steps = lesson.steps.size();
  coach.now.prompt = lesson.steps[coach.now.step].prompt;
  coach.now.hint = lesson.steps[coach.now.step].hint;
  coach.now.feedback = {"The lever moved 0.12 s before the clutch was down.",
                        "The engine stalled: it fell from 640 rpm within a second."};
  return coach;
}

inline lessons::ShiftRecord shift_of(std::int64_t number, int from, int to, double begin) {
  lessons::ShiftRecord shift;
  shift.number = number;
  shift.from = from;
  shift.to = to;
  shift.begin = begin;
  shift.end = begin + 0.84;
  shift.clutch_lag = 0.12;
  shift.rev_error = 25.0;
  return shift;
}

// The result of a lesson run with these errors, graded as at the end of a run.
inline lessons::LessonResult result_of(std::string_view key, std::vector<lessons::DrivingError> errors,
                                       bool guided = false) {
  lessons::LessonResult result;
  const lessons::Lesson lesson = shipped_lesson(key);
  result.lesson = lesson.key;
  result.task = lesson.task;
  result.end = lessons::LessonEnd::done;
  result.guided = guided;
  result.begin = 12.0;
  result.duration = 34.0;
  result.errors = std::move(errors);
  result.shifts = {shift_of(0, haptics::kNeutralGear, 1, 13.0), shift_of(1, 1, 2, 19.5)};
  result.shifts[1].block_time = 0.31;
  result.shifts[1].clutch_lag = -0.08;
  lessons::grade_result(lesson, result);
  return result;
}

inline std::vector<lessons::DrivingError> some_errors() {
  return {make_driving_error(lessons::ErrorKind::jerk, lessons::Severity::minor, 14.2, 9.7, 0),
          make_driving_error(lessons::ErrorKind::grind, lessons::Severity::minor, 19.9, 12.4, 1),
          make_driving_error(lessons::ErrorKind::wrong_column, lessons::Severity::note, 20.1, 2.0, 1)};
}
inline std::vector<lessons::DrivingError> failing_errors() {
  std::vector<lessons::DrivingError> errors = some_errors();
  errors.push_back(make_driving_error(lessons::ErrorKind::stall, lessons::Severity::very_severe, 31.0, 62.0, -1));
  errors.push_back(make_driving_error(lessons::ErrorKind::throttle_in_shift, lessons::Severity::minor, 33.0, 80.0, 1));
  errors.push_back(make_driving_error(lessons::ErrorKind::rollback, lessons::Severity::severe, 36.5, 0.42, -1));
  errors.push_back(make_driving_error(lessons::ErrorKind::over_push, lessons::Severity::minor, 37.0, 48.0, -1));
  errors.push_back(make_driving_error(lessons::ErrorKind::clutch_dump, lessons::Severity::severe, 38.0, 32000.0, -1));
  return errors;
}

// Norm in which every figure of result_of() is typical, except the largest jerk, which is six times as large.
inline const lessons::Norm& some_norm() {
  static const lessons::Norm norm = [] {
    lessons::Norm made;
    made.figures = {lessons::FigureNorm{900.0, 1.3}, lessons::FigureNorm{20.0, 1.2}, lessons::FigureNorm{25.0, 1.3},
                    lessons::FigureNorm{0.05, 1.5},  lessons::FigureNorm{0.1, 1.5},  lessons::FigureNorm{1.1, 1.05},
                    lessons::FigureNorm{2.0, 1.3}};
    made.limit = 2.2;
    return made;
  }();
  return norm;
}

// The same run, judged by that norm.
inline lessons::LessonResult with_norm(lessons::LessonResult result) {
  result.slip_energy = 880.0;
  result.figures = {120.0, 24.0, 0.04, 0.11, 1.08, 1.9, std::nullopt};
  lessons::grade_result(shipped_lesson(result.lesson), result, &some_norm());
  return result;
}

inline CoachState over(const lessons::LessonResult& result) {
  CoachState coach = driven(result.lesson);
  coach.phase = lessons::LessonPhase::over;
  coach.result = result;
  if (result.score) coach.norm = &some_norm();
  if (result.passed) coach.mastery = lessons::mastery_sentence(lessons::Mastery::passed_once);
  coach.guidance = result.guided ? 0.8 : 0.0;
  coach.next = result.passed ? "emergency_stop" : "hill_start";
  return coach;
}

// A learner with six runs, newest first: passed, failed, guided, left, interrupted, incomplete. The newest run has a
// comment.
inline CoachState with_history() {
  CoachState coach = half_way();
  const auto add = [&](std::int64_t id, const char* at, lessons::LessonResult result, const char* recording) {
    coach.runs.push_back({id, 1, at, recording, std::move(result)});
  };
  lessons::LessonResult left = result_of("reverse", {}), cut = left, lost = left;
  left.end = lessons::LessonEnd::left;
  left.passed = false;
  left.why = "You left the lesson.";
  cut.end = lessons::LessonEnd::running;
  lost.is_complete = false;
  add(16, "2026-01-02T10:31:00Z", result_of("hill_start", some_errors()), "/tmp/hill.trace");
  add(15, "2026-01-02T10:20:00Z", result_of("hill_start", failing_errors()), "");
  add(14, "2026-01-02T10:11:00Z", result_of("down_through_the_gears", some_errors(), true), "/tmp/down.trace");
  add(13, "2026-01-01T09:11:00Z", left, "");
  add(12, "2026-01-01T09:05:00Z", cut, "");
  add(11, "2026-01-01T09:00:00Z", lost, "");
  coach.runs[0].comments = {{"2026-01-02T11:00:00Z", "Ms Torque", "Wait for the synchroniser: push, do not hit."}};
  return coach;
}

}  // namespace gearshift::test
