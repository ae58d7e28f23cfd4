#include "app/lessons/assessment/suggest.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

namespace gearshift::lessons {
namespace {

constexpr std::size_t kLastResults = 3;  // engineering value

bool was_passed(std::span<const GradedTrial> past, std::string_view lesson) {
  return std::any_of(past.begin(), past.end(), [&](const GradedTrial& r) { return r.passed && r.lesson == lesson; });
}

bool is_weaker(const RecentResults& a, const RecentResults& b) noexcept {
  const int more = a.failed * b.runs - b.failed * a.runs;  // compares the fractions of failed runs
  return more != 0 ? more > 0 : a.grade < b.grade;
}

// True if at least half of the recent runs failed. A lesson that was never passed counts as weak only after three runs,
// because failed runs are normal at first.
bool is_weak(const RecentResults& form, bool passed_once) noexcept {
  const bool tried = passed_once || form.runs >= static_cast<int>(kLastResults);
  return tried && 2 * form.failed >= form.runs;
}

// Returns the weakest lesson among those passed once or, with `only_weak`, among those for which is_weak() is true.
const Lesson* weakest(std::span<const Lesson> lessons, std::span<const GradedTrial> past, bool only_weak) {
  const Lesson* found = nullptr;
  RecentResults lowest;
  for (const Lesson& lesson : lessons) {
    const std::optional<RecentResults> form = recent_results(past, lesson.task);
    if (!form) continue;
    const bool passed_once = was_passed(past, lesson.key);
    if (only_weak ? !is_weak(*form, passed_once) : !passed_once) continue;
    if (found != nullptr && !is_weaker(*form, lowest)) continue;
    found = &lesson;
    lowest = *form;
  }
  return found;
}

std::string weak_lesson_text(const Lesson& lesson, const RecentResults& form) {
  return fmt::format("{} needs practice: {} of the last {} attempts failed (average grade {:.1f}).", lesson.title,
                     form.failed, form.runs, form.grade);
}

}  // namespace

std::optional<RecentResults> recent_results(std::span<const GradedTrial> past, std::string_view task) {
  RecentResults form;
  for (std::size_t i = past.size(); i > 0 && form.runs < static_cast<int>(kLastResults); --i) {
    if (past[i - 1].task != task) continue;
    ++form.runs;
    form.failed += past[i - 1].passed ? 0 : 1;
    form.grade += past[i - 1].grade;
  }
  if (form.runs == 0) return std::nullopt;
  form.grade /= form.runs;
  return form;
}

std::optional<double> task_grade(std::span<const GradedTrial> past, std::string_view task) {
  const std::optional<RecentResults> form = recent_results(past, task);
  return form ? std::optional(form->grade) : std::nullopt;
}

std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const GradedTrial> past) {
  if (lessons.empty()) return std::nullopt;
  if (const Lesson* lesson = weakest(lessons, past, true)) {
    return Suggestion{lesson->key, weak_lesson_text(*lesson, *recent_results(past, lesson->task))};
  }
  const auto open =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& lesson) { return !was_passed(past, lesson.key); });
  if (open != lessons.end()) return Suggestion{open->key, fmt::format("You haven't passed {} yet.", open->title)};
  const Lesson* lesson = weakest(lessons, past, false);
  return Suggestion{
      lesson->key, fmt::format("You have passed all lessons; {} is the weakest, with a recent average grade of {:.1f}.",
                               lesson->title, *task_grade(past, lesson->task))};
}

}  // namespace gearshift::lessons
