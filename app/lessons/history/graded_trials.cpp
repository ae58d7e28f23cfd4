#include "app/lessons/history/graded_trials.h"

#include <map>
#include <string>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/guidance.h"
#include "app/lessons/history/utc_time.h"

namespace gearshift::lessons {

std::optional<double> retention_pause(std::optional<std::int64_t> before, std::optional<std::int64_t> now) noexcept {
  if (!before || !now || *now - *before < kRetentionPause) return std::nullopt;
  return static_cast<double>(*now - *before);
}

std::vector<GradedTrial> graded_trials(std::span<const RunRow> runs) {
  std::vector<GradedTrial> trials;
  std::map<std::string, std::optional<std::int64_t>> last;  // [s] since 1970, begin of a lesson's last run
  for (const RunRow& run : runs) {
    if (!was_completed(run)) continue;
    const LessonResult& result = run.result;
    const std::optional<std::int64_t> begun = parse_utc(run.begun_at);
    const double pause = retention_pause(last[result.lesson], begun).value_or(0.0);
    last[result.lesson] = begun;
    if (is_graded(result))
      trials.push_back({result.lesson, result.task, result.grade, result.passed, run.id, run.begun_at, pause, begun,
                        result.car, result.path_length});
  }
  return trials;
}

std::vector<UngradedTrial> ungraded_trials(std::span<const RunRow> runs) {
  std::vector<UngradedTrial> trials;
  for (const RunRow& run : runs) {
    const LessonResult& result = run.result;
    if (result.end != LessonEnd::running && !is_graded(result))
      trials.push_back({result.task, result.end == LessonEnd::left, result.guided});
  }
  return trials;
}

}  // namespace gearshift::lessons
