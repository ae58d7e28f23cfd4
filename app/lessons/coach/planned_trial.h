// Plans the next trial of a lesson from the learner's past runs.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "app/lessons/assessment/guidance.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct PlannedTrial {
  TrialPlan plan;
  bool retention = false;  // first trial after kRetentionPause: unguided, without hints
};

// Feeds the completed runs of the lesson, including retention tests, to a GuidancePolicy. Skips runs that ended early.
// The same runs always give the same plan. `runs`: all runs of this learner, oldest first. `now`: [s] since 1970.
PlannedTrial plan_trial(std::string_view learner, const Lesson& lesson, std::span<const RunRow> runs, std::int64_t now);

}  // namespace gearshift::lessons
