// From rows to what a learner has done and how the grades go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/learner_history.h"
#include "app/training/grade.h"
#include "app/training/learning_curve.h"
#include "app/training/suggest.h"

namespace gearshift {

inline constexpr LevelBounds kGrades{0.0, kBestGrade};

std::string day_of(std::string_view time);  // "2026-01-02" of ISO 8601

struct Totals {
  std::size_t days = 0, sessions = 0, runs = 0, shifts = 0;
  double driven = 0.0;              // [s] in runs that are over
  std::string first_day, last_day;  // empty where there is none
};
Totals totals(const LearnerHistory& history);

struct GradedTrial {
  std::int64_t run = 0;
  std::string day;
  double grade = 0.0;  // [1] of 10
  bool passed = false;
  double pause = 0.0;  // [s] before it, where it shows what was kept (retention.h); else 0
};
struct TaskProgress {
  std::string task;
  std::vector<GradedTrial> trials;  // oldest first, at least one
  std::optional<LearningCurve> curve;
};
std::vector<TaskProgress> task_progress(const LearnerHistory& history);  // in the order in which they were begun

std::vector<PastResult> past_results(const LearnerHistory& history);  // graded runs, oldest first

}  // namespace gearshift
