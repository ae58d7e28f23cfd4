#include "app/training/suggest.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

#include "app/training/grade.h"

namespace gearshift {
namespace {

constexpr std::size_t kLastResults = 3;  // [engineering value]

bool was_passed(std::span<const PastResult> past, std::string_view lesson) {
  return std::any_of(past.begin(), past.end(), [&](const PastResult& r) { return r.passed && r.lesson == lesson; });
}

// The lesson with the lowest grade of its task; where `only_weak`, among those that were passed once and are weak now.
const Lesson* weakest(std::span<const Lesson> lessons, std::span<const PastResult> past, bool only_weak) {
  const Lesson* found = nullptr;
  double lowest = 0.0;
  for (const Lesson& lesson : lessons) {
    const std::optional<double> grade = task_grade(past, lesson.task);
    if (!grade || !was_passed(past, lesson.key)) continue;
    if (only_weak && *grade >= lesson.pass_grade) continue;
    if (found != nullptr && *grade >= lowest) continue;
    found = &lesson;
    lowest = *grade;
  }
  return found;
}

}  // namespace

std::optional<PastResult> past_result(const LessonResult& result) {
  if (!is_graded(result)) return std::nullopt;
  return PastResult{result.lesson, result.task, result.grade, result.passed};
}

std::optional<double> task_grade(std::span<const PastResult> past, std::string_view task) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = past.size(); i > 0 && count < kLastResults; --i) {
    if (past[i - 1].task != task) continue;
    sum += past[i - 1].grade;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const PastResult> past) {
  if (lessons.empty()) return std::nullopt;
  if (const Lesson* lesson = weakest(lessons, past, true)) {
    return Suggestion{lesson->key, fmt::format("{} has become weak: {:.1f} on average lately.", lesson->title,
                                               *task_grade(past, lesson->task))};
  }
  const auto open =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& lesson) { return !was_passed(past, lesson.key); });
  if (open != lessons.end()) return Suggestion{open->key, fmt::format("{} was not yet passed.", open->title)};
  const Lesson* lesson = weakest(lessons, past, false);
  return Suggestion{lesson->key, fmt::format("All are passed; {} is the weakest, {:.1f} on average lately.",
                                             lesson->title, *task_grade(past, lesson->task))};
}

}  // namespace gearshift
