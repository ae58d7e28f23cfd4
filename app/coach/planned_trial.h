// How the next trial of a lesson is driven: from what this learner has done in it so far.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "app/history/history.h"
#include "app/training/guidance.h"

namespace gearshift {

struct PlannedTrial {
  TrialPlan plan;
  bool retention = false;  // the first trial after the pause: unguided and silent
};

// The policy goes through every run of the lesson that is over, retention tests too, but for those that were left: the
// same runs, the same plan, in this program or the next. runs: of this learner, oldest first; now: [s] since 1970.
PlannedTrial plan_trial(std::string_view learner, std::string_view lesson, std::span<const RunRow> runs,
                        std::int64_t now);

}  // namespace gearshift
