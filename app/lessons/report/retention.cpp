#include "app/lessons/report/retention.h"

#include <fmt/format.h>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/guidance.h"
#include "app/lessons/history/utc_time.h"

namespace gearshift::lessons {
namespace {

constexpr double kHour = 3600.0, kDay = 24.0 * kHour;  // [s]

struct Past {                         // state of one lesson
  std::optional<std::int64_t> begun;  // [s] since 1970, start of the last run
  std::optional<RetentionTrial::Before> graded;
};

std::optional<double> pause_before(const Past& past, std::optional<std::int64_t> begun) {
  if (!past.begun || !begun) return std::nullopt;
  const auto pause = static_cast<double>(*begun - *past.begun);
  return pause >= static_cast<double>(kRetentionPause) ? std::optional(pause) : std::nullopt;
}

}  // namespace

std::vector<RetentionTrial> retention_trials(const LearnerHistory& history) {
  std::vector<RetentionTrial> trials;
  std::map<std::string, Past> lessons;
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    if (!was_completed(run.row)) continue;  // skips runs that ended early, as the coach does
    Past& past = lessons[result.lesson];
    const std::optional<std::int64_t> begun = parse_utc(run.row.begun_at);
    const std::optional<double> pause = pause_before(past, begun);
    past.begun = begun;
    if (!is_graded(result)) continue;
    if (pause) trials.push_back({run.row.id, result.lesson, *pause, result.grade, past.graded});
    past.graded = {run.row.id, result.grade};
  }
  return trials;
}

std::map<std::int64_t, double> retention_pauses(const LearnerHistory& history) {
  std::map<std::int64_t, double> pauses;
  for (const RetentionTrial& trial : retention_trials(history)) pauses[trial.run] = trial.pause;
  return pauses;
}

std::string format_pause(double seconds) {
  if (seconds < 2.0 * kDay) return fmt::format("{:.0f} hours", seconds / kHour);
  return fmt::format("{:.0f} days", seconds / kDay);
}

}  // namespace gearshift::lessons
