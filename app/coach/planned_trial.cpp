#include "app/coach/planned_trial.h"

#include <optional>
#include <string>

#include "app/training/grade.h"
#include "haptics/files/fnv_1a.h"

namespace gearshift {
namespace {

// The name tells learners apart, with a history or without; no name has a zero in it.
std::uint64_t seed_of(std::string_view learner, std::string_view lesson) {
  return fnv_1a(std::string(learner) + '\0' + std::string(lesson));
}

bool is_after_pause(const std::optional<std::int64_t>& last, std::int64_t now) {
  return last && now - *last >= kRetentionPause;
}

}  // namespace

PlannedTrial plan_trial(std::string_view learner, std::string_view lesson, std::span<const RunRow> runs,
                        std::int64_t now) {
  GuidancePolicy policy(seed_of(learner, lesson));
  std::optional<std::int64_t> last;
  for (const RunRow& run : runs) {
    if (run.result.lesson != lesson || !was_driven(run)) continue;  // one that was left is offered again as it was
    (void)policy.next();
    policy.learn(run_error(run.result));
    last = seconds_of(run.begun_at);
  }
  if (is_after_pause(last, now)) return {policy.retention(), true};
  return {policy.next(), false};
}

}  // namespace gearshift
