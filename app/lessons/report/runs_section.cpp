#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"

namespace gearshift::lessons {
namespace {

// Returns the points that the error cost. If it cost none, as in a guided run, returns the error's severity.
std::string format_cost(const DrivingError& error) {
  if (error.points > 0.0) return fmt::format("<strong>−{:.1f}</strong>", error.points);
  return title_from_key(to_string(error.severity)) + ":";
}

// Returns text such as "−2.0 The engine stalled: .... (12.4 s into the run, shift 3)", plus advice if `advised`.
std::string error_item(const LessonResult& result, const DrivingError& error, bool advised) {
  const std::string shift = error.shift >= 0 ? fmt::format(", shift {}", error.shift + 1) : std::string();
  const std::string advice =
      advised ? fmt::format("<br><span class=\"soft\">{}</span>", base::html_text(error_advice(error.kind)))
              : std::string();
  return fmt::format("<li>{} {} <span class=\"soft\">({:.1f} s into the run{})</span>{}</li>", format_cost(error),
                     base::html_text(error_sentence(error)), error.time - result.begin, shift, advice);
}

// Lists the errors, with advice for the first error of each kind that cost points.
std::string error_list(const LessonResult& result) {
  if (result.errors.empty()) return {};
  std::string list = "<ul>";
  std::set<ErrorKind> advised;
  for (const DrivingError& error : result.errors)
    list += error_item(result, error, error.points > 0.0 && advised.insert(error.kind).second);
  return list + "</ul>";
}

// If more points were lost than the best grade has, shows how many, because the grade then does not.
std::string format_lost_points(const LessonResult& result) {
  const double points = points_lost(result);
  if (!is_graded(result) || points <= kBestGrade) return {};
  return fmt::format("<br><span class=\"soft\">{:.1f} points lost; the lowest grade is 0</span>", points);
}

std::string format_outcome(const LessonResult& result) {
  const std::string rule =
      is_graded(result) && result.grading == Grading::old_rule ? "<br><span class=\"soft\">by the old rule</span>" : "";
  if (result.passed) return "<span class=\"passed\">passed</span>" + rule;
  if (result.end == LessonEnd::running) return "never finished";
  const std::string why = result.why.empty() ? std::string() : "<br>" + base::html_text(result.why);
  return (is_graded(result) ? "<span class=\"failed\">not passed</span>" : "not graded") + rule + why +
         format_lost_points(result);
}

// Lists the figures of a run that was judged by a norm: "Largest jerk 31 m/s³ (norm up to 34 m/s³)".
std::string figures_list(const LessonResult& result, std::span<const Lesson> lessons) {
  if (!result.score) return {};
  const auto lesson =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == result.lesson; });
  std::string list;
  for (const FigureLine& line : figure_lines(result, lesson != lessons.end() ? norm_of(*lesson, result.mode) : nullptr))
    list += fmt::format("{}{} {}{}{}", list.empty() ? "" : "; ", line.label, line.value,
                        line.norm.empty() ? "" : " (norm " + line.norm + ")", line.is_worse ? " !" : "");
  return "<p class=\"soft\">" + base::html_text(list) + "</p>";
}

// Comments are placed below the driving errors, because few runs have comments and a separate column would waste space.
std::string comments_list(const std::vector<CommentRow>& comments) {
  std::string list;
  for (const CommentRow& comment : comments) {
    const std::string edited =
        comment.edited_at.empty() ? std::string() : ", edited " + base::html_text(day_of(comment.edited_at));
    list +=
        fmt::format("<blockquote>{} <span class=\"soft\">{}, {}{}</span></blockquote>", base::html_text(comment.text),
                    base::html_text(comment.author), base::html_text(day_of(comment.at)), edited);
  }
  return list;
}

std::string format_begin(const std::string& begun_at) {  // "2026-01-02<br>10:00"
  return fmt::format("{}<br><span class=\"soft\">{}</span>", base::html_text(day_of(begun_at)),
                     base::html_text(begun_at.size() >= 16 ? begun_at.substr(11, 5) : std::string()));
}

// `pause` [s]: break before a retention trial; 0 for any other run.
std::string format_mode(const LessonResult& result, double pause) {
  std::string words = result.mode == LessonMode::follow_me ? "follow me" : "do it yourself";
  if (result.guided) words += ", guided";
  return pause > 0.0 ? words + fmt::format("<br>after a break of {}", format_pause(pause)) : words;
}

std::string run_row(const RunRow& run, std::span<const Lesson> lessons, double pause) {
  const LessonResult& result = run.result;
  return fmt::format(
      "<tr id=\"run-{0}\"><td class=\"number\">{0}</td><td class=\"day\">{1}</td><td>{2}<br><span "
      "class=\"soft\">{3}</span></td><td class=\"number\">{4}</td><td class=\"number\"><strong>{5}</strong></td>"
      "<td>{6}</td><td>{7}{8}</td></tr>\n",
      run.id, format_begin(run.begun_at), base::html_text(lesson_title(lessons, result.lesson)),
      format_mode(result, pause), result.shifts.size(),
      is_graded(result) ? fmt::format("{:.1f}", result.grade) : std::string("–"), format_outcome(result),
      error_list(result) + figures_list(result, lessons),
      (run.kept_at.empty() ? "" : "<p class=\"soft\">Recording: " + base::html_text(run.kept_at) + "</p>") +
          comments_list(run.comments));
}

}  // namespace

std::string runs_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  if (history.runs.empty()) return section("runs", "Runs", paragraph("No runs yet."));
  std::string table =
      "<table class=\"runs\">\n<thead><tr><th class=\"number\">Run</th><th>Day</th><th>Lesson</th>"
      "<th class=\"number\">Shifts</th><th class=\"number\">Grade</th><th>Result</th>"
      "<th>Findings and comments</th></tr></thead>\n<tbody>\n";
  std::map<std::int64_t, double> pauses;
  for (const GradedTrial& trial : graded_trials(history.runs)) pauses[trial.run] = trial.pause;
  for (auto run = history.runs.rbegin(); run != history.runs.rend(); ++run)
    table += run_row(*run, lessons, pauses[run->id]);
  const bool has_norms = std::any_of(history.runs.begin(), history.runs.end(),
                                     [](const RunRow& run) { return run.result.score.has_value(); });
  const std::string origin = has_norms ? paragraph(std::string(kNormOrigin)) : std::string();
  return section("runs", "Runs, newest first", origin + table + "</tbody></table>\n");
}

}  // namespace gearshift::lessons
