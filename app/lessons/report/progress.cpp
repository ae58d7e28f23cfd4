#include "app/lessons/report/progress.h"

#include <algorithm>
#include <set>

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
  for (const RunRow& run : history.runs) {
    days.insert(day_of(run.begun_at));
    sessions.insert(run.session);
    sum.shifts += run.result.shifts.size();
    sum.driven += run.result.duration;
  }
  sum.runs = history.runs.size();
  sum.days = days.size();
  sum.sessions = sessions.size();
  if (!days.empty()) sum.first_day = *days.begin(), sum.last_day = *days.rbegin();
  return sum;
}

std::vector<TaskProgress> task_progress(const LearnerHistory& history) {
  std::vector<TaskProgress> tasks;
  for (const GradedTrial& trial : graded_trials(history.runs)) progress_of(tasks, trial.task).trials.push_back(trial);
  for (TaskProgress& task : tasks) task.curve = fit_learning_curve(grades_of(task.trials), kGrades);
  return tasks;
}

}  // namespace gearshift::lessons
