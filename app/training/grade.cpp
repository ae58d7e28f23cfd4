#include "app/training/grade.h"

#include <algorithm>
#include <string>

#include <fmt/core.h>

namespace gearshift {
namespace {

// [engineering value]s: with a pass grade of 6, eight minor faults or two severe ones still pass, one more does not.
constexpr std::array<double, 4> kPoints{0.0, 0.5, 2.0, 4.0};

double points_of_all(std::span<const DriveFault> faults) noexcept {
  double points = 0.0;
  for (const DriveFault& fault : faults) points += points_of(fault.severity);
  return points;
}

// Slower than within_s, but not yet so slow that the step fails.
bool is_still_forgiven(const Lesson& lesson, const DriveFault& fault) {
  return std::any_of(lesson.steps.begin(), lesson.steps.end(), [&](const LessonStep& step) {
    return step.fails_after && step.prompt == fault.step && fault.value < *step.fails_after;
  });
}

// Minor or severe: its threshold is the tolerance.
const DriveFault* failing_fault(const Lesson& lesson, const LessonResult& result) {
  const auto fails = [&](const DriveFault& fault) {
    return catches(lesson, fault.kind) && !is_still_forgiven(lesson, fault);
  };
  const auto found = std::find_if(result.faults.begin(), result.faults.end(), fails);
  return found == result.faults.end() ? nullptr : &*found;
}

// Why it was not passed; empty: it was. An abort's own words are kept.
std::string reason(const Lesson& lesson, const LessonResult& result) {
  if (result.guided) return "The lever was guided: such a trial is not graded.";
  if (!result.had_forces) return "The lever was without forces: it is not graded.";
  if (!result.whole) return "A part of the drive was lost: it is not graded.";
  if (result.end == LessonEnd::aborted && !result.why.empty()) return result.why;
  if (result.end == LessonEnd::left) return "The lesson was left.";  // whatever was wrong before
  if (const DriveFault* fault = failing_fault(lesson, result)) return fault_sentence(*fault);
  if (result.end == LessonEnd::aborted) return "The lesson was broken off.";
  if (result.end == LessonEnd::out_of_time) return fmt::format("It was not done in {:.0f} s.", lesson.time_limit);
  if (result.end == LessonEnd::running) return "The lesson is not over.";
  if (result.grade >= lesson.pass_grade) return {};
  return fmt::format("Grade {:.1f} is below {:.1f}.", result.grade, lesson.pass_grade);
}

}  // namespace

double points_of(Severity severity) noexcept {
  return kPoints[static_cast<std::size_t>(severity)];
}

std::array<std::size_t, 4> count_by_severity(std::span<const DriveFault> faults) noexcept {
  std::array<std::size_t, 4> counts{};
  for (const DriveFault& fault : faults) ++counts[static_cast<std::size_t>(fault.severity)];
  return counts;
}

void grade_result(const Lesson& lesson, LessonResult& result) {
  result.deductions.clear();
  result.grade = 0.0;
  if (!result.guided && result.whole) {
    for (std::size_t i = 0; i < result.faults.size(); ++i) {
      const double points = points_of(result.faults[i].severity);
      if (points > 0.0) result.deductions.push_back({i, points});
    }
    const bool fell_short = result.end == LessonEnd::aborted || result.end == LessonEnd::out_of_time;
    result.grade = fell_short ? 0.0 : std::max(0.0, kBestGrade - points_of_all(result.faults));
  }
  result.why = reason(lesson, result);
  result.passed = result.why.empty();
}

bool is_graded(const LessonResult& result) noexcept {
  const bool judged = result.end != LessonEnd::running && result.end != LessonEnd::left;
  return !result.guided && result.whole && judged;
}

double run_error(const LessonResult& result) noexcept {
  if (result.end != LessonEnd::done) return 1.0;
  return std::min(1.0, points_of_all(result.faults) / kBestGrade);
}

}  // namespace gearshift
