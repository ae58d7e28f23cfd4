#include "app/lessons/assessment/mastery.h"

#include <optional>
#include <string>

namespace gearshift::lessons {

Mastery mastery_of(std::span<const GradedTrial> past, std::string_view lesson) {
  std::optional<std::string> first_day;  // of the first pass
  bool has_driven_another = false;       // since the first pass
  for (const GradedTrial& trial : past) {
    if (trial.lesson != lesson) {
      has_driven_another = has_driven_another || first_day;
      continue;
    }
    if (!trial.passed) continue;
    const std::string day = trial.begun_at.substr(0, 10);  // "2026-01-02"
    if (!first_day) {
      first_day = day;
    } else if (has_driven_another || day != *first_day) {
      return Mastery::mastered;
    }
  }
  return first_day ? Mastery::passed_once : Mastery::not_passed;
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
