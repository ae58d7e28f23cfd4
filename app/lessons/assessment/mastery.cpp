#include "app/lessons/assessment/mastery.h"

#include <algorithm>

namespace gearshift::lessons {

Mastery mastery_of(std::span<const GradedTrial> past, std::string_view lesson) {
  if (was_confirmed(past, lesson, &GradedTrial::lesson)) return Mastery::mastered;
  const bool has_pass = std::any_of(past.begin(), past.end(),
                                    [&](const GradedTrial& trial) { return trial.passed && trial.lesson == lesson; });
  return has_pass ? Mastery::passed_once : Mastery::not_passed;
}

std::string_view mastery_sentence(Mastery mastery) noexcept {
  switch (mastery) {
    case Mastery::not_passed:
      return "Not passed yet.";
    case Mastery::passed_once:
      return "Passed once. Pass it again tomorrow or after another lesson.";
    case Mastery::mastered:
      return "Mastered: passed twice.";
  }
  return {};
}

}  // namespace gearshift::lessons
