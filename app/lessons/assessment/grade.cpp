#include "app/lessons/assessment/grade.h"

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr double kBestScore = 0.5;       // [1] part of the norm's limit up to which the grade is 10
constexpr double kWorstScore = 3.0;      // [1] at this multiple of the limit the grade is 0
constexpr double kGradeStep = 0.1;       // [1] grades are shown with one decimal
constexpr double kUsualPassGrade = 6.0;  // [1] the default of Lesson::pass_grade

bool is_of_lever(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::riding_lever:
    case ErrorKind::grind:
    case ErrorKind::blocked:
    case ErrorKind::missed_shift:
    case ErrorKind::wrong_gear:
    case ErrorKind::wrong_column:
    case ErrorKind::over_push:
      return true;
    default:
      return false;
  }
}

// Points of the errors of some kinds, also of guided runs, whose errors cost none.
double points_by_severity(const LessonResult& result, bool (*counts)(ErrorKind)) noexcept {
  double points = 0.0;
  for (const DrivingError& error : result.errors)
    if (counts(error.kind)) points += points_of(error.severity);
  return points;
}

// Returns the first error that fails the lesson, or null. Even a minor error can fail the lesson, because the error's
// threshold already includes a tolerance.
const DrivingError* failing_error(const Lesson& lesson, const LessonResult& result) {
  const auto fails = [&](const DrivingError& error) {
    const bool is_severe = error.severity >= Severity::severe;
    return (is_severe || fails_on(lesson, error.kind)) && !is_within_tolerance(lesson, error);
  };
  const auto found = std::find_if(result.errors.begin(), result.errors.end(), fails);
  return found == result.errors.end() ? nullptr : &*found;
}

// Returns why the lesson was not passed; empty if it was passed. If an abort condition has already set `result.why`,
// returns that text, unless the run is not graded.
std::string reason(const Lesson& lesson, const LessonResult& result, const Norm* norm) {
  if (result.guided && result.lever_help == 0.0) return "Not graded: you had help with the pedals.";
  if (result.guided) return "Not graded: the lever was guiding you.";
  if (!result.had_forces) return "Not graded: the lever's forces were off.";
  if (!result.is_complete) return "Not graded: part of the drive was not recorded.";
  if (result.end == LessonEnd::aborted && !result.why.empty()) return result.why;
  if (result.end == LessonEnd::left) return "You left the lesson.";  // takes precedence over earlier errors
  if (const DrivingError* error = failing_error(lesson, result)) return error_sentence(*error);
  if (result.end == LessonEnd::aborted) return "The lesson was stopped early.";
  if (result.end == LessonEnd::out_of_time) return fmt::format("Not finished within {:.0f} s.", lesson.time_limit);
  if (result.end == LessonEnd::running) return "The lesson is not over yet.";
  const double by_errors = std::max(0.0, kBestGrade - points_lost(result));
  if (by_errors < lesson.pass_grade)
    return fmt::format("Grade {:.1f} is below the pass grade of {:.1f}.", result.grade, lesson.pass_grade);
  return result.score.value_or(0.0) > 1.0 ? worst_figure_sentence(result, *norm) : std::string();
}

double grade_by_score(double score, double pass_grade) noexcept {
  const double beyond = (score - 1.0) / (kWorstScore - 1.0), before = (1.0 - score) / (1.0 - kBestScore);
  if (score > 1.0) return pass_grade * std::max(0.0, 1.0 - beyond);
  return pass_grade + (kBestGrade - pass_grade) * std::min(1.0, before);
}

double limb_error(const LessonResult& result, const Norm* norm, bool of_lever) noexcept {
  const double points = points_by_severity(
      result, of_lever ? is_of_lever : [](ErrorKind kind) { return !is_of_lever(kind); });
  const bool is_judged = norm != nullptr && result.score;
  const double score = is_judged ? limb_distance(result, *norm, of_lever) / norm->limit : 0.0;
  return std::min(1.0, std::max(points, kUsualPassGrade - grade_by_score(score, kUsualPassGrade)) / kBestGrade);
}

double rounded_down(double grade) noexcept {
  return std::floor(grade / kGradeStep + 1e-9) * kGradeStep;
}

}  // namespace

double points_of(Severity severity) noexcept {
  return kPoints[static_cast<std::size_t>(severity)];
}

void grade_result(const Lesson& lesson, LessonResult& result, const Norm* norm) {
  const bool counts = !result.guided && result.is_complete;
  const bool was_not_completed = result.end == LessonEnd::aborted || result.end == LessonEnd::out_of_time;
  for (DrivingError& error : result.errors) error.points = counts ? points_of(error.severity) : 0.0;
  result.grading = norm != nullptr ? Grading::norm : Grading::errors;
  result.score.reset();
  if (norm != nullptr && result.end == LessonEnd::done) result.score = distance(result, *norm) / norm->limit;
  const double by_errors = std::max(0.0, kBestGrade - points_lost(result));
  const double by_score = result.score ? grade_by_score(*result.score, lesson.pass_grade) : kBestGrade;
  result.grade = counts && !was_not_completed ? rounded_down(std::min(by_errors, by_score)) : 0.0;
  result.why = reason(lesson, result, norm);
  result.passed = result.why.empty();
  if (result.passed) result.grade = std::max(result.grade, lesson.pass_grade);
  if (!result.passed) result.grade = std::max(0.0, std::min(result.grade, lesson.pass_grade - kGradeStep));
}

std::string_view thing_to_mend(const Lesson& lesson, const LessonResult& result, const Norm* norm) {
  if (const DrivingError* error = failing_error(lesson, result)) return error_advice(error->kind);
  const auto is_milder = [](const DrivingError& a, const DrivingError& b) { return a.severity < b.severity; };
  const auto costliest = std::max_element(result.errors.begin(), result.errors.end(), is_milder);
  const bool has_error = costliest != result.errors.end() && costliest->severity > Severity::note;
  const bool has_score = norm != nullptr && result.score;
  const bool is_rough = has_score && *result.score > 1.0;
  if (has_error && !is_rough) return error_advice(costliest->kind);
  const RunFigure* worst = has_score ? worst_figure(result, *norm) : nullptr;
  if (worst == nullptr) return {};
  for (const FigureLine& line : figure_lines(result, norm))
    if (line.figure == worst && (is_rough || line.is_worse)) return worst->advice;
  return {};
}

std::string_view what_was_good(const LessonResult& result) noexcept {
  const auto has = [&](std::initializer_list<ErrorKind> kinds) {
    return std::any_of(result.errors.begin(), result.errors.end(), [&](const DrivingError& error) {
      return error.severity > Severity::note && std::find(kinds.begin(), kinds.end(), error.kind) != kinds.end();
    });
  };
  const bool has_error = std::any_of(result.errors.begin(), result.errors.end(),
                                     [](const DrivingError& error) { return error.severity > Severity::note; });
  if (result.end == LessonEnd::left || result.end == LessonEnd::running) return {};
  if (result.end == LessonEnd::done && !has_error) return "every step, without an error.";
  if (!result.shifts.empty() && !has({ErrorKind::grind, ErrorKind::no_clutch, ErrorKind::missed_shift,
                                      ErrorKind::wrong_gear, ErrorKind::wrong_column}))
    return "the lever found its gears, without grinding.";
  if (!has({ErrorKind::stall}) && result.duration > 0.0) return "the engine kept running.";
  return result.end == LessonEnd::done ? "you finished every step." : std::string_view();
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
  const double by_score = result.score ? kBestGrade - grade_by_score(*result.score, kUsualPassGrade) : 0.0;
  return std::min(1.0, std::max(by_score, points_by_severity(result, [](ErrorKind) { return true; })) / kBestGrade);
}

double lever_error(const LessonResult& result, const Norm* norm) noexcept {
  return limb_error(result, norm, true);
}

double pedal_error(const LessonResult& result, const Norm* norm) noexcept {
  return limb_error(result, norm, false);
}

}  // namespace gearshift::lessons
