#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"

namespace gearshift::lessons {
namespace {

struct LearnerStanding {
  const LearnerHistory* history = nullptr;
  std::vector<TaskStanding> tasks;
  NextLesson next;

  std::size_t count(Standing standing) const {
    return static_cast<std::size_t>(
        std::count_if(tasks.begin(), tasks.end(), [&](const TaskStanding& task) { return task.standing == standing; }));
  }
};

constexpr Standing kShown[] = {Standing::can, Standing::nearly, Standing::not_yet, Standing::not_tried};

std::string count_cells(const auto& count) {
  std::string cells;
  for (const Standing standing : kShown) cells += fmt::format("<td class=\"number\">{}</td>", count(standing));
  return cells;
}

constexpr const char* kCountHeads =
    "<th class=\"number\">Can</th><th class=\"number\">Nearly</th><th class=\"number\">Not yet</th>"
    "<th class=\"number\">Not tried</th>";

std::string overview(const std::vector<LearnerStanding>& learners, std::span<const Lesson> lessons) {
  std::string table = fmt::format(
      "<table class=\"class\">\n<thead><tr><th>Learner</th><th>Last day</th><th class=\"number\">Runs</th>{}"
      "<th>Next lesson</th></tr></thead>\n<tbody>\n",
      kCountHeads);
  for (const LearnerStanding& one : learners) {
    const Totals sum = totals(*one.history);
    table += fmt::format(
        "<tr><td><a href=\"#learner-{}\">{}</a></td><td class=\"day\">{}</td><td class=\"number\">{}</td>{}<td>{}</td>"
        "</tr>\n",
        one.history->learner.id, base::html_text(one.history->learner.name),
        sum.last_day.empty() ? "–" : base::html_text(sum.last_day), sum.runs,
        count_cells([&](Standing standing) { return one.count(standing); }),
        base::html_text(lesson_title(lessons, one.next.lesson)));
  }
  return table + "</tbody></table>\n";
}

// <bdi> keeps a name that is written from right to left from reordering what follows it.
std::string name_html(const LearnerHistory& history) {
  return "<bdi>" + base::html_text(history.learner.name) + "</bdi>";
}

std::string names_with(const std::vector<LearnerStanding>& learners, const std::string& task, Standing standing) {
  std::string names;
  for (const LearnerStanding& one : learners) {
    for (const TaskStanding& each : one.tasks) {
      if (each.task == task && each.standing == standing)
        names += (names.empty() ? "" : ", ") + name_html(*one.history);
    }
  }
  return names;
}

// Tasks with the learners who need help, in teaching order.
std::string task_overview(const std::vector<LearnerStanding>& learners, std::span<const Lesson> lessons) {
  std::string table = fmt::format(
      "<table class=\"class\">\n<thead><tr><th>Task</th>{}<th>Not yet able</th></tr></thead>\n<tbody>\n", kCountHeads);
  for (const TaskStanding& task : task_standings({}, lessons)) {
    const auto count = [&](Standing standing) {
      return std::count_if(learners.begin(), learners.end(), [&](const LearnerStanding& one) {
        return std::any_of(one.tasks.begin(), one.tasks.end(), [&](const TaskStanding& each) {
          return each.task == task.task && each.standing == standing;
        });
      });
    };
    table += fmt::format("<tr><td>{}</td>{}<td>{}</td></tr>\n", base::html_text(task_title(lessons, task.task)),
                         count_cells(count), names_with(learners, task.task, Standing::not_yet));
  }
  return table + "</tbody></table>\n";
}

// The tasks with this standing, as the end of a list: "Can: Reverse, Hill start."
std::string task_list(const LearnerStanding& one, Standing standing, std::string_view label,
                      std::span<const Lesson> lessons) {
  std::string titles;
  for (const TaskStanding& task : one.tasks) {
    if (task.standing == standing) titles += (titles.empty() ? "" : ", ") + task_title(lessons, task.task);
  }
  return titles.empty() ? titles : paragraph(fmt::format("{}: {}.", label, titles));
}

std::string learner_part(const LearnerStanding& one, std::span<const Lesson> lessons) {
  std::string html = fmt::format("<div class=\"learner\">\n<h3 id=\"learner-{}\">{}</h3>\n", one.history->learner.id,
                                 base::html_text(one.history->learner.name));
  if (!one.next.lesson.empty())
    html += fmt::format("<p class=\"next\">Next lesson: <strong>{}</strong>. {}</p>\n",
                        base::html_text(lesson_title(lessons, one.next.lesson)), base::html_text(one.next.why));
  std::vector<TaskStanding> open;
  std::copy_if(one.tasks.begin(), one.tasks.end(), std::back_inserter(open), [](const TaskStanding& task) {
    return task.standing == Standing::not_yet || task.standing == Standing::nearly;
  });
  if (!open.empty())
    html += "<table class=\"standings\">\n<tbody>\n" + standing_rows(*one.history, open, lessons, true) +
            "</tbody></table>\n";
  return html + task_list(one, Standing::can, "Can", lessons) +
         task_list(one, Standing::not_tried, "Not tried", lessons) + "</div>\n";
}

}  // namespace

std::string class_page(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons) {
  std::vector<LearnerStanding> all;
  for (const LearnerHistory& history : learners)
    all.push_back({&history, task_standings(history, lessons), next_lesson(history, lessons)});
  std::string page = page_begin("Class: driving report") +
                     fmt::format("<header>\n<h1>Class</h1>\n<p class=\"soft\">{} learner{}</p>\n</header>\n",
                                 all.size(), all.size() == 1 ? "" : "s");
  if (all.empty()) return page + paragraph("No learners yet.") + page_end();
  page +=
      section("learners", "Learners", overview(all, lessons)) + section("tasks", "Tasks", task_overview(all, lessons));
  std::string parts;
  for (const LearnerStanding& one : all) parts += learner_part(one, lessons);
  return page + section("each", "Learner by learner", parts) + page_end();
}

}  // namespace gearshift::lessons
