// Computes totals and the progress of grades from a learner's rows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/learning_curve.h"
#include "app/lessons/history/graded_trials.h"
#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

inline constexpr LevelBounds kGrades{0.0, kBestGrade};

std::string day_of(std::string_view time);  // "2026-01-02", the day of an ISO 8601 time

struct Totals {
  std::size_t days = 0, sessions = 0, runs = 0, shifts = 0;
  double driven = 0.0;              // [s] driving time in finished runs
  std::string first_day, last_day;  // empty if there are no runs
};
Totals totals(const LearnerHistory& history);

struct TaskProgress {
  std::string task;
  std::vector<GradedTrial> trials;  // oldest first, at least one
  std::optional<LearningCurve> curve;
};
std::vector<TaskProgress> task_progress(const LearnerHistory& history);  // in the order of their first runs

}  // namespace gearshift::lessons
