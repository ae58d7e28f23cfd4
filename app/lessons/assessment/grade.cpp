#include "app/lessons/assessment/grade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <fmt/core.h>

namespace gearshift::lessons {
namespace {

// Points deducted by severity. Engineering values: with a pass grade of 6, a run passes with up to eight minor errors
// or up to two severe ones.
constexpr std::array<double, 4> kPoints{0.0, 0.5, 2.0, 4.0};

// True if the error is a step that took longer than the step's `within`, but less than its `fails_after`.
bool is_within_tolerance(const Lesson& lesson, const DrivingError& error) {
  return std::any_of(lesson.steps.begin(), lesson.steps.end(), [&](const LessonStep& step) {
    return step.fails_after && step.prompt == error.step && error.duration < *step.fails_after;
  });
}

// Returns the first error that fails the lesson, or null. Even a minor error can fail the lesson, because the error's
// threshold already includes a tolerance.
const DrivingError* failing_error(const Lesson& lesson, const LessonResult& result) {
  const auto fails = [&](const DrivingError& error) {
    return fails_on(lesson, error.kind) && !is_within_tolerance(lesson, error);
  };
  const auto found = std::find_if(result.errors.begin(), result.errors.end(), fails);
  return found == result.errors.end() ? nullptr : &*found;
}

// Returns why the lesson was not passed; empty if it was passed. If an abort condition has already set `result.why`,
// returns that text, unless the run is not graded.
std::string reason(const Lesson& lesson, const LessonResult& result) {
  if (result.guided) return "Not graded: the lever was guiding you.";
  if (!result.had_forces) return "Not graded: the lever's forces were off.";
  if (!result.is_complete) return "Not graded: part of the drive was not recorded.";
  if (result.end == LessonEnd::aborted && !result.why.empty()) return result.why;
  if (result.end == LessonEnd::left) return "You left the lesson.";  // takes precedence over earlier errors
  if (const DrivingError* error = failing_error(lesson, result)) return error_sentence(*error);
  if (result.end == LessonEnd::aborted) return "The lesson was stopped early.";
  if (result.end == LessonEnd::out_of_time) return fmt::format("Not finished within {:.0f} s.", lesson.time_limit);
  if (result.end == LessonEnd::running) return "The lesson is not over yet.";
  if (result.grade >= lesson.pass_grade) return {};
  return fmt::format("Grade {:.1f} is below the pass grade of {:.1f}.", result.grade, lesson.pass_grade);
}

}  // namespace

double points_of(Severity severity) noexcept {
  return kPoints[static_cast<std::size_t>(severity)];
}

void grade_result(const Lesson& lesson, LessonResult& result) {
  const bool counts = !result.guided && result.is_complete;
  const bool was_not_completed = result.end == LessonEnd::aborted || result.end == LessonEnd::out_of_time;
  for (DrivingError& error : result.errors) error.points = counts ? points_of(error.severity) : 0.0;
  result.grade = counts && !was_not_completed ? std::max(0.0, kBestGrade - points_lost(result)) : 0.0;
  result.why = reason(lesson, result);
  result.passed = result.why.empty();
}

double points_lost(const LessonResult& result) noexcept {
  double points = 0.0;
  for (const DrivingError& error : result.errors) points += error.points;
  return points;
}

bool is_graded(const LessonResult& result) noexcept {
  const bool judged = result.end != LessonEnd::running && result.end != LessonEnd::left;
  return !result.guided && result.is_complete && judged;
}

double run_error(const LessonResult& result) noexcept {
  if (result.end != LessonEnd::done) return 1.0;
  double points = 0.0;  // also of guided runs, whose errors cost none
  for (const DrivingError& error : result.errors) points += points_of(error.severity);
  return std::min(1.0, points / kBestGrade);
}

}  // namespace gearshift::lessons
