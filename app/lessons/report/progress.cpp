#include "app/lessons/report/progress.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "app/lessons/report/retention.h"

namespace gearshift::lessons {
namespace {

std::vector<double> grades_of(const std::vector<GradedTrial>& trials) {
  std::vector<double> grades;
  grades.reserve(trials.size());
  for (const GradedTrial& trial : trials) grades.push_back(trial.grade);
  return grades;
}

TaskProgress& progress_of(std::vector<TaskProgress>& tasks, const std::string& task) {
  const auto found = std::find_if(tasks.begin(), tasks.end(), [&](const TaskProgress& t) { return t.task == task; });
  if (found != tasks.end()) return *found;
  tasks.push_back({task, {}, {}});
  return tasks.back();
}

}  // namespace

std::string day_of(std::string_view time) {
  return std::string(time.substr(0, 10));
}

Totals totals(const LearnerHistory& history) {
  Totals sum;
  std::set<std::string> days;
  std::set<std::int64_t> sessions;
  for (const ReportedRun& run : history.runs) {
    days.insert(day_of(run.row.begun_at));
    sessions.insert(run.row.session);
    sum.shifts += run.row.result.shifts.size();
    sum.driven += run.row.result.duration;
  }
  sum.runs = history.runs.size();
  sum.days = days.size();
  sum.sessions = sessions.size();
  if (!days.empty()) sum.first_day = *days.begin(), sum.last_day = *days.rbegin();
  return sum;
}

std::vector<TaskProgress> task_progress(const LearnerHistory& history) {
  std::vector<TaskProgress> tasks;
  const std::map<std::int64_t, double> pauses = retention_pauses(history);
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    if (!is_graded(result)) continue;
    const auto pause = pauses.find(run.row.id);
    progress_of(tasks, result.task)
        .trials.push_back({run.row.id, day_of(run.row.begun_at), result.grade, result.passed,
                           pause == pauses.end() ? 0.0 : pause->second});
  }
  for (TaskProgress& task : tasks) task.curve = fit_learning_curve(grades_of(task.trials), kGrades);
  return tasks;
}

std::vector<PastResult> past_results(const LearnerHistory& history) {
  std::vector<PastResult> past;
  for (const ReportedRun& run : history.runs) {
    if (std::optional<PastResult> result = past_result(run.row.result)) past.push_back(std::move(*result));
  }
  return past;
}

}  // namespace gearshift::lessons
