#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"
#include "app/lessons/report/standing.h"

namespace gearshift::lessons {
namespace {

std::string total_item(std::string_view id, std::string_view name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd id=\"{}\">{}</dd></div>\n", name, id, value);
}

std::string format_days(const Totals& sum) {
  if (sum.days == 0) return "No lessons driven yet.";
  if (sum.days == 1) return sum.first_day;
  return sum.first_day + " to " + sum.last_day;
}

std::string next_paragraph(const LearnerHistory& history, std::span<const Lesson> lessons) {
  LearnerHistory unchosen = history;
  unchosen.learner.next_lesson.clear();
  const NextLesson next = next_lesson(history, lessons), suggested = next_lesson(unchosen, lessons);
  if (next.lesson.empty()) return {};
  const std::string title = base::html_text(lesson_title(lessons, next.lesson));
  if (!next.by_instructor)
    return fmt::format("<p class=\"next\" id=\"next\">Next lesson: <strong>{}</strong>. {}</p>\n", title,
                       base::html_text(next.why));
  return fmt::format(
      "<p class=\"next\" id=\"next\">Next lesson: <strong>{}</strong>, chosen by the instructor. Based on the "
      "grades, the next lesson would be {}. {}</p>\n",
      title, base::html_text(lesson_title(lessons, suggested.lesson)), base::html_text(suggested.why));
}

}  // namespace

std::string head_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const Totals sum = totals(history);
  std::string head = fmt::format("<header>\n<h1>{}</h1>\n<p class=\"soft\">{}</p>\n",
                                 base::html_text(history.learner.name), base::html_text(format_days(sum)));
  head += "<dl class=\"totals\">\n" + total_item("days", "days", std::to_string(sum.days)) +
          total_item("sessions", "sessions", std::to_string(sum.sessions)) +
          total_item("lesson-runs", "lesson runs", std::to_string(sum.runs)) +
          total_item("shift-count", "shifts", std::to_string(sum.shifts)) +
          total_item("minutes", "minutes driven", fmt::format("{:.1f}", sum.driven / 60.0)) + "</dl>\n";
  return head + next_paragraph(history, lessons) + "</header>\n";
}

}  // namespace gearshift::lessons
