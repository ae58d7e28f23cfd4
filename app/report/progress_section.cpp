#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/draw/html.h"
#include "app/report/learning_svg.h"
#include "app/report/progress.h"
#include "app/report/retention.h"
#include "app/report/sections.h"
#include "app/report/words.h"

namespace gearshift {
namespace {

constexpr std::size_t kFewestForCurve = 5;  // as fit_learning_curve has it
constexpr std::size_t kFewestForChart = 3;

std::string estimate(const Estimate& e) {
  return number_words(e.value, 2) + " ± " + number_words(e.deviation, 2);
}

std::string level_words(const LearningCurve& curve) {
  return curve.at_bound ? number_words(curve.level.value, 0) + " (the level is at its bound)" : estimate(curve.level);
}

std::string fit_words(const TaskProgress& task) {
  if (task.curve) {
    return fmt::format("A = {}, B = {}, τ = {} runs; a run scatters by {:.2f} about the curve.",
                       level_words(*task.curve), estimate(task.curve->gain), estimate(task.curve->trials),
                       task.curve->noise);
  }
  if (task.trials.size() < kFewestForCurve)
    return fmt::format("No curve yet: it takes {} graded runs, there are {}.", kFewestForCurve, task.trials.size());
  const auto [least, most] = std::minmax_element(task.trials.begin(), task.trials.end(),
                                                 [](const auto& a, const auto& b) { return a.grade < b.grade; });
  if (least->grade == most->grade)
    return fmt::format("No curve: all {} grades are {:.1f}.", task.trials.size(), most->grade);
  return fmt::format("No curve: in these {} grades no learning stands out from their scatter.", task.trials.size());
}

std::string task_row(const TaskProgress& task, std::span<const PastResult> past, std::span<const Lesson> lessons) {
  const auto best = std::max_element(task.trials.begin(), task.trials.end(),
                                     [](const GradedTrial& a, const GradedTrial& b) { return a.grade < b.grade; });
  const auto passed =
      std::count_if(task.trials.begin(), task.trials.end(), [](const GradedTrial& t) { return t.passed; });
  std::string row = fmt::format("<tr><td>{}</td>", html_text(task_title(lessons, task.task)));
  const auto number = [&](const std::string& text) { row += "<td class=\"number\">" + text + "</td>"; };
  number(std::to_string(task.trials.size()));
  number(std::to_string(passed));
  number(fmt::format("{:.1f}", task.trials.front().grade));
  number(fmt::format("{:.1f}", best->grade));
  number(fmt::format("{:.1f}", task.trials.back().grade));
  number(fmt::format("{:.1f}", task_grade(past, task.task).value_or(0.0)));
  return row + "</tr>\n";
}

std::string task_table(const std::vector<TaskProgress>& tasks, std::span<const PastResult> past,
                       std::span<const Lesson> lessons) {
  std::string table =
      "<table class=\"tasks\">\n<thead><tr><th>Task</th><th class=\"number\">Graded runs</th><th "
      "class=\"number\">Passed</th>"
      "<th class=\"number\">First</th><th class=\"number\">Best</th><th class=\"number\">Last</th>"
      "<th class=\"number\">Mean of the last three</th></tr></thead>\n<tbody>\n";
  for (const TaskProgress& task : tasks) table += task_row(task, past, lessons);
  return table + "</tbody></table>\n";
}

std::string curve_figure(const TaskProgress& task, std::span<const Lesson> lessons) {
  return fmt::format("<figure class=\"curve\">\n<h3>{}</h3>\n{}<figcaption>{}</figcaption></figure>\n",
                     html_text(task_title(lessons, task.task)), learning_svg(task), html_text(fit_words(task)));
}

bool has_chart(const TaskProgress& task) {
  return task.trials.size() >= kFewestForChart;
}

std::string charts(const std::vector<TaskProgress>& tasks, std::span<const Lesson> lessons) {
  std::string figures;
  for (const TaskProgress& task : tasks) {
    if (has_chart(task)) figures += curve_figure(task, lessons);
  }
  return figures.empty() ? figures : "<div class=\"curves\">\n" + figures + "</div>\n";
}

// "Reverse: 8.0 (Run 3), 8.5 (Run 7)"
std::string grades_item(const TaskProgress& task, std::span<const Lesson> lessons) {
  std::string grades;
  for (const GradedTrial& trial : task.trials) {
    const std::string grade = fmt::format("{:.1f} ({})", trial.grade, run_link(trial.run));
    grades += (grades.empty() ? "" : ", ") + grade;
  }
  return fmt::format("<li>{}: {}</li>", html_text(task_title(lessons, task.task)), grades);
}

// The tasks that a chart would be empty for, all in one row.
std::string few_runs(const std::vector<TaskProgress>& tasks, std::span<const Lesson> lessons) {
  std::string items;
  for (const TaskProgress& task : tasks) {
    if (!has_chart(task)) items += grades_item(task, lessons);
  }
  if (items.empty()) return {};
  return fmt::format(
      "<table class=\"few\">\n<tbody><tr><th>Fewer than {} graded runs</th><td><ul>{}</ul></td></tr></tbody></table>\n",
      kFewestForChart, items);
}

constexpr const char* kHowToRead =
    "A dot is a graded run, hollow where it was not passed; guided runs are left out. The line is the fit "
    "grade(n) = A + B exp(−n/τ), n = 0 for the first run: A is where practice leads, B how far the first run was from "
    "it (negative below), τ how many runs it takes until all but 37 % is learnt. Pale: where the curve is with about "
    "95 % confidence. After ± stands one standard deviation. A grade is 10 at most and 0 at least, and so is A: where "
    "the grades alone would lead beyond, A is at its bound, and what is said of B and τ holds for that A. A ring about "
    "a dot: the first run of its lesson after a day or more without it.";

// The newest of a lesson after a day, and after a week.
struct Kept {
  std::string lesson;  // key
  std::optional<RetentionTrial> day, week;
};

std::vector<Kept> kept_lessons(const LearnerHistory& history) {
  std::vector<Kept> kept;
  for (const RetentionTrial& trial : retention_trials(history)) {
    auto found = std::find_if(kept.begin(), kept.end(), [&](const Kept& k) { return k.lesson == trial.lesson; });
    if (found == kept.end()) found = kept.insert(kept.end(), Kept{trial.lesson, {}, {}});
    (trial.pause < kWeekAfter ? found->day : found->week) = trial;
  }
  return kept;
}

std::string kept_cells(const std::optional<RetentionTrial>& trial) {
  if (!trial) return "<td class=\"number\">–</td><td class=\"number\"></td><td></td>";
  return fmt::format("<td class=\"number\">{}</td><td class=\"number\"><strong>{}</strong></td><td>{}, {}</td>",
                     trial->before ? number_words(trial->before->grade, 1) : "–", number_words(trial->grade, 1),
                     run_link(trial->run), pause_words(trial->pause));
}

constexpr const char* kWhatIsKept =
    "Grades of the last graded run before a pause, and of the first run after it: what is left of a lesson after 20 "
    "hours or more without it, and after six days or more. The newest of each.";

std::string kept_part(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const std::vector<Kept> kept = kept_lessons(history);
  const std::string head = "<h3>What was kept</h3>\n";
  if (kept.empty()) return head + paragraph("No lesson was driven again after a day without it yet.");
  std::string table = fmt::format(
      "<table class=\"kept\">\n<caption>{}</caption>\n<thead><tr><th>Lesson</th><th class=\"number\">Before</th>"
      "<th class=\"number\">After a day</th><th></th><th class=\"number\">Before</th>"
      "<th class=\"number\">After a week</th><th></th></tr></thead>\n<tbody>\n",
      kWhatIsKept);
  for (const Kept& k : kept) {
    table += fmt::format("<tr><td>{}</td>{}{}</tr>\n", html_text(lesson_title(lessons, k.lesson)), kept_cells(k.day),
                         kept_cells(k.week));
  }
  return head + table + "</tbody></table>\n";
}

}  // namespace

std::string progress_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const std::vector<TaskProgress> tasks = task_progress(history);
  if (tasks.empty()) return section("learning", "Learning", paragraph("There is no graded run yet."));
  std::string html = task_table(tasks, past_results(history), lessons);
  if (const std::string figures = charts(tasks, lessons); !figures.empty())
    html += figures + few_runs(tasks, lessons) + "<p class=\"soft\">" + kHowToRead + "</p>\n";
  else
    html += few_runs(tasks, lessons);
  return section("learning", "Learning", html + kept_part(history, lessons));
}

}  // namespace gearshift
