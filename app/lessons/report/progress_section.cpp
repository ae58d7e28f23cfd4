#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/curve_band.h"
#include "app/lessons/report/learning_svg.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"

namespace gearshift::lessons {
namespace {

constexpr std::size_t kMinRunsForCurve = 5;  // equal to kMinTrials in learning_curve.cpp
constexpr std::size_t kMinRunsForChart = 3;

constexpr double kSettled = 0.25;  // [1] distance from the level below which more practice changes little

// Where more practice leads, as the end of a sentence about the typical grade `now`.
std::string format_outlook(const LearningCurve& curve, double now) {
  const bool is_level = std::abs(curve.level.value - now) < kSettled;
  if (curve.at_bound)
    return is_level ? std::string() : fmt::format(" and is still changing, towards {:.0f}", curve.level.value);
  const auto grade = [](double value) { return std::clamp(value, kGrades.lowest, kGrades.highest); };
  const double margin = kBandDeviations * curve.level.deviation;
  return fmt::format(" and {} {:.1f} (most likely {:.1f} to {:.1f})", is_level ? "stays near" : "should settle near",
                     grade(curve.level.value), grade(curve.level.value - margin), grade(curve.level.value + margin));
}

std::string describe_curve(const TaskProgress& task) {
  const LearningCurve& curve = *task.curve;
  const auto at = [&](std::size_t trial) {
    return std::clamp(curve.at(static_cast<double>(trial)), kGrades.lowest, kGrades.highest);
  };
  const double first = at(0), now = at(task.trials.size() - 1);
  return fmt::format("The typical grade {} from {:.1f} to {:.1f} in {} runs{}. Single runs are about {:.1f} off it.",
                     now >= first ? "rose" : "fell", first, now, task.trials.size(), format_outlook(curve, now),
                     curve.noise);
}

std::string describe_fit(const TaskProgress& task) {
  if (task.curve) return describe_curve(task);
  if (task.trials.size() < kMinRunsForCurve)
    return fmt::format("No trend yet: {} graded runs needed, {} so far.", kMinRunsForCurve, task.trials.size());
  const auto [lowest, highest] = std::minmax_element(task.trials.begin(), task.trials.end(),
                                                     [](const auto& a, const auto& b) { return a.grade < b.grade; });
  if (lowest->grade == highest->grade)
    return fmt::format("All {} grades are {:.1f}.", task.trials.size(), highest->grade);
  return fmt::format("No clear trend: the {} grades vary between {:.1f} and {:.1f}.", task.trials.size(), lowest->grade,
                     highest->grade);
}

std::string task_row(const TaskProgress& task, std::span<const GradedTrial> past, std::span<const Lesson> lessons) {
  const auto best = std::max_element(task.trials.begin(), task.trials.end(),
                                     [](const GradedTrial& a, const GradedTrial& b) { return a.grade < b.grade; });
  const auto passed =
      std::count_if(task.trials.begin(), task.trials.end(), [](const GradedTrial& t) { return t.passed; });
  std::string row = fmt::format("<tr><td>{}</td>", base::html_text(task_title(lessons, task.task)));
  const auto number = [&](const std::string& text) { row += "<td class=\"number\">" + text + "</td>"; };
  number(std::to_string(task.trials.size()));
  number(std::to_string(passed));
  number(fmt::format("{:.1f}", task.trials.front().grade));
  number(fmt::format("{:.1f}", best->grade));
  number(fmt::format("{:.1f}", task.trials.back().grade));
  number(fmt::format("{:.1f}", recent_results(past, task.task).value_or(RecentResults{}).grade));
  return row + "</tr>\n";
}

std::string task_table(const std::vector<TaskProgress>& tasks, std::span<const GradedTrial> past,
                       std::span<const Lesson> lessons) {
  std::string table =
      "<table class=\"tasks\">\n<thead><tr><th>Task</th><th class=\"number\">Graded runs</th><th "
      "class=\"number\">Passed</th>"
      "<th class=\"number\">First</th><th class=\"number\">Best</th><th class=\"number\">Last</th>"
      "<th class=\"number\">Recent grade</th></tr></thead>\n<tbody>\n";
  for (const TaskProgress& task : tasks) table += task_row(task, past, lessons);
  return table + "</tbody></table>\n";
}

std::string curve_figure(const TaskProgress& task, std::span<const Lesson> lessons) {
  return fmt::format("<figure class=\"curve\">\n<h3>{}</h3>\n{}<figcaption>{}</figcaption></figure>\n",
                     base::html_text(task_title(lessons, task.task)), learning_svg(task),
                     base::html_text(describe_fit(task)));
}

bool has_chart(const TaskProgress& task) {
  return task.trials.size() >= kMinRunsForChart;
}

std::string charts(const std::vector<TaskProgress>& tasks, std::span<const Lesson> lessons) {
  std::string figures;
  for (const TaskProgress& task : tasks) {
    if (has_chart(task)) figures += curve_figure(task, lessons);
  }
  return figures.empty() ? figures : "<div class=\"curves\">\n" + figures + "</div>\n";
}

// Returns text such as "Reverse: 8.0 (Run 3), 8.5 (Run 7)".
std::string grades_item(const TaskProgress& task, std::span<const Lesson> lessons) {
  std::string grades;
  for (const GradedTrial& trial : task.trials) {
    const std::string grade = fmt::format("{:.1f} ({})", trial.grade, run_link(trial.run));
    grades += (grades.empty() ? "" : ", ") + grade;
  }
  return fmt::format("<li>{}: {}</li>", base::html_text(task_title(lessons, task.task)), grades);
}

// Lists the tasks with too few runs for a chart, all in one row.
std::string few_runs(const std::vector<TaskProgress>& tasks, std::span<const Lesson> lessons) {
  std::string items;
  for (const TaskProgress& task : tasks) {
    if (!has_chart(task)) items += grades_item(task, lessons);
  }
  if (items.empty()) return {};
  return fmt::format(
      "<table class=\"few\">\n<tbody><tr><th>Fewer than {} graded runs</th><td><ul>{}</ul></td></tr></tbody></table>\n",
      kMinRunsForChart, items);
}

constexpr const char* kHowToRead =
    "Each dot is a graded run, hollow if not passed; guided and unfinished runs are left out. A ring marks the first "
    "run "
    "of its lesson after a break of a day or more. The line is the typical grade, which changes fast at first and then "
    "ever more slowly; it lies in the pale band with about 95 % confidence.";

constexpr double kWeekAfter = 6.0 * 24.0 * 3600.0;  // [s] a break at least this long counts as a week

struct Retention {
  GradedTrial after;                  // the first trial after a break
  std::optional<GradedTrial> before;  // the lesson's last trial before it
};

// The newest retention of a lesson, after a day and after a week.
struct RetentionRow {
  std::string lesson;  // key
  std::optional<Retention> day, week;
};

std::vector<RetentionRow> retention_rows(const LearnerHistory& history) {
  std::vector<RetentionRow> rows;
  std::map<std::string, GradedTrial> newest;  // by lesson
  for (const GradedTrial& trial : graded_trials(history.runs)) {
    const auto before = newest.find(trial.lesson);
    if (trial.pause > 0.0) {
      auto found =
          std::find_if(rows.begin(), rows.end(), [&](const RetentionRow& k) { return k.lesson == trial.lesson; });
      if (found == rows.end()) found = rows.insert(rows.end(), RetentionRow{trial.lesson, {}, {}});
      std::optional<Retention>& cell = trial.pause < kWeekAfter ? found->day : found->week;
      cell = Retention{trial, std::nullopt};
      if (before != newest.end()) cell->before = before->second;
    }
    newest[trial.lesson] = trial;
  }
  return rows;
}

std::string retention_cells(const std::optional<Retention>& retention) {
  if (!retention) return "<td class=\"number\">–</td><td class=\"number\"></td><td></td>";
  const auto& [after, before] = *retention;
  return fmt::format("<td class=\"number\">{}</td><td class=\"number\"><strong>{}</strong></td><td>{}, {}</td>",
                     before ? format_number(before->grade, 1) : "–", format_number(after.grade, 1), run_link(after.run),
                     format_pause(after.pause));
}

constexpr const char* kRetentionCaption =
    "How much of a lesson is retained after a break: the grades of the last graded run before the break and of the "
    "first run after the break. A day means a break of at least 20 hours, a week means a break of at least six days; "
    "only the newest of each is shown.";

std::string retention_part(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const std::vector<RetentionRow> rows = retention_rows(history);
  const std::string head = "<h3>Retention</h3>\n";
  if (rows.empty()) return head + paragraph("No lesson has been repeated after a day's break yet.");
  std::string table = fmt::format(
      "<table class=\"kept\">\n<caption>{}</caption>\n<thead><tr><th>Lesson</th><th class=\"number\">Before</th>"
      "<th class=\"number\">After a day</th><th></th><th class=\"number\">Before</th>"
      "<th class=\"number\">After a week</th><th></th></tr></thead>\n<tbody>\n",
      kRetentionCaption);
  for (const RetentionRow& k : rows) {
    table += fmt::format("<tr><td>{}</td>{}{}</tr>\n", base::html_text(lesson_title(lessons, k.lesson)),
                         retention_cells(k.day), retention_cells(k.week));
  }
  return head + table + "</tbody></table>\n";
}

}  // namespace

std::string standing_rows(const LearnerHistory& history, std::span<const TaskStanding> tasks,
                          std::span<const Lesson> lessons, bool with_curve) {
  const std::vector<TaskProgress> progress = task_progress(history);
  std::string rows;
  for (const TaskStanding& task : tasks) {
    std::string name(to_string(task.standing)), kind = name, why = task.sentence;
    std::replace(kind.begin(), kind.end(), ' ', '_');
    for (const TaskProgress& each : progress) {
      if (with_curve && each.task == task.task && each.curve) why += " " + describe_curve(each);
    }
    rows += fmt::format("<tr><td>{}</td><td class=\"standing {}\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        base::html_text(task_title(lessons, task.task)), kind, name, base::html_text(why),
                        base::html_text(task.advice));
  }
  return rows;
}

std::string standing_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  return section(
      "standing", "What the learner can do",
      fmt::format("<table class=\"standings\">\n<thead><tr><th>Task</th><th>Status</th><th>Why</th><th>Next</th>"
                  "</tr></thead>\n<tbody>\n{}</tbody></table>\n",
                  standing_rows(history, task_standings(history, lessons), lessons, false)));
}

std::string progress_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const std::vector<TaskProgress> tasks = task_progress(history);
  if (tasks.empty()) return section("learning", "Learning", paragraph("No graded runs yet."));
  std::string html = task_table(tasks, graded_trials(history.runs), lessons);
  if (const std::string figures = charts(tasks, lessons); !figures.empty())
    html += figures + few_runs(tasks, lessons) + "<p class=\"soft\">" + kHowToRead + "</p>\n";
  else
    html += few_runs(tasks, lessons);
  return section("learning", "Learning", html + retention_part(history, lessons));
}

}  // namespace gearshift::lessons
