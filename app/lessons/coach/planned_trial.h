// Plans the next trial of a lesson from the learner's past runs.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "app/lessons/assessment/guidance.h"
#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct PlannedTrial {
  TrialPlan plan;
  bool retention = false;  // first trial after the pause: unguided, without hints
};

// Replays all completed runs of the lesson, retention tests included, through the policy; runs ended early are left
// out. The same runs give the same plan in any program. runs: of this learner, oldest first; now: [s] since 1970.
PlannedTrial plan_trial(std::string_view learner, std::string_view lesson, std::span<const RunRow> runs,
                        std::int64_t now);

}  // namespace gearshift::lessons
