#include "app/lessons/coach/planned_trial.h"

#include <optional>
#include <string>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/history/graded_trials.h"
#include "haptics/files/fnv_1a.h"

namespace gearshift::lessons {
namespace {

// The seed depends only on the names of learner and lesson, not on the history. A zero byte separates the two names.
std::uint64_t seed_of(std::string_view learner, std::string_view lesson) {
  return haptics::fnv_1a(std::string(learner) + '\0' + std::string(lesson));
}

}  // namespace

PlannedTrial plan_trial(std::string_view learner, const Lesson& lesson, std::span<const RunRow> runs,
                        std::int64_t now) {
  GuidancePolicy policy(seed_of(learner, lesson.key));
  std::optional<std::int64_t> last;
  for (const RunRow& run : runs) {
    // Skip a run that ended early, so that the next trial uses the plan of that run again.
    if (run.result.lesson != lesson.key || !was_completed(run)) continue;
    (void)policy.next();
    const Norm* norm = norm_of(lesson, run.result.mode);
    policy.learn(run_error(run.result), lever_error(run.result, norm), pedal_error(run.result, norm));
    last = parse_utc(run.begun_at);
  }
  if (retention_pause(last, now)) return {policy.retention(), true};
  return {policy.next(), false};
}

}  // namespace gearshift::lessons
