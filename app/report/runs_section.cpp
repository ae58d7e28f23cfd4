#include <cstdint>
#include <map>
#include <set>

#include <fmt/format.h>

#include "app/draw/html.h"
#include "app/report/progress.h"
#include "app/report/retention.h"
#include "app/report/sections.h"
#include "app/report/words.h"

namespace gearshift {
namespace {

double points_of_fault(const LessonResult& result, std::size_t fault) {
  double points = 0.0;
  for (const Deduction& deduction : result.deductions) {
    if (deduction.fault == fault) points += deduction.points;
  }
  return points;
}

// What it cost, or, where it cost nothing, how bad it is: that of a guided run is not graded.
std::string cost_words(const DriveFault& fault, double points) {
  if (points > 0.0) return fmt::format("<strong>−{:.1f}</strong>", points);
  return plain_words(severity_key(fault.severity)) + ":";
}

// "−2.0 The engine stalled, from 350 rpm. (12.4 s into the run, shift 3)", and what to do about it.
std::string fault_item(const LessonResult& result, std::size_t i, bool advised) {
  const DriveFault& fault = result.faults[i];
  const std::string cost = cost_words(fault, points_of_fault(result, i));
  const std::string shift = fault.shift >= 0 ? fmt::format(", shift {}", fault.shift + 1) : std::string();
  const std::string advice =
      advised ? fmt::format("<br><span class=\"soft\">{}</span>", html_text(fault_advice(fault.kind))) : std::string();
  return fmt::format("<li>{} {} <span class=\"soft\">({:.1f} s into the run{})</span>{}</li>", cost,
                     html_text(fault_sentence(fault)), fault.time - result.begin, shift, advice);
}

// What to do is said once of each kind that cost something.
std::string faults_list(const LessonResult& result) {
  if (result.faults.empty()) return {};
  std::string list = "<ul>";
  std::set<FaultKind> advised;
  for (std::size_t i = 0; i < result.faults.size(); ++i) {
    const bool costs = points_of_fault(result, i) > 0.0;
    list += fault_item(result, i, costs && advised.insert(result.faults[i].kind).second);
  }
  return list + "</ul>";
}

// Where the faults would take more than there is, the sum is said: the points of the list do not add up to the grade.
std::string beyond_words(const LessonResult& result) {
  double points = 0.0;
  for (const Deduction& deduction : result.deductions) points += deduction.points;
  if (!is_graded(result) || points <= kBestGrade) return {};
  return fmt::format("<br><span class=\"soft\">{:.1f} points lost; no grade is below 0</span>", points);
}

std::string outcome(const LessonResult& result) {
  if (result.passed) return "<span class=\"passed\">passed</span>";
  if (result.end == LessonEnd::running) return "never ended";
  const std::string why = result.why.empty() ? std::string() : "<br>" + html_text(result.why);
  return (is_graded(result) ? "<span class=\"failed\">not passed</span>" : "not graded") + why + beyond_words(result);
}

// Below what was seen: few runs have one, and a column of its own takes the room of the others.
std::string comments_list(const std::vector<CommentRow>& comments) {
  std::string list;
  for (const CommentRow& comment : comments) {
    const std::string edited =
        comment.edited_at.empty() ? std::string() : ", changed " + html_text(day_of(comment.edited_at));
    list += fmt::format("<blockquote>{} <span class=\"soft\">{}, {}{}</span></blockquote>", html_text(comment.text),
                        html_text(comment.author), html_text(day_of(comment.at)), edited);
  }
  return list;
}

std::string time_words(const std::string& begun_at) {  // "2026-01-02<br>10:00"
  return fmt::format("{}<br><span class=\"soft\">{}</span>", html_text(day_of(begun_at)),
                     html_text(begun_at.size() >= 16 ? begun_at.substr(11, 5) : std::string()));
}

// pause: [s] before a run that shows what was kept; else 0.
std::string mode_words(const LessonResult& result, double pause) {
  std::string words = result.mode == LessonMode::follow_me ? "follow me" : "by yourself";
  if (result.guided) words += ", guided";
  return pause > 0.0 ? words + fmt::format("<br>after a pause of {}", pause_words(pause)) : words;
}

std::string run_row(const ReportedRun& run, std::span<const Lesson> lessons, double pause) {
  const LessonResult& result = run.row.result;
  return fmt::format(
      "<tr id=\"run-{0}\"><td class=\"number\">{0}</td><td class=\"day\">{1}</td><td>{2}<br><span "
      "class=\"soft\">{3}</span></td><td class=\"number\">{4}</td><td class=\"number\"><strong>{5}</strong></td>"
      "<td>{6}</td><td>{7}{8}</td></tr>\n",
      run.row.id, time_words(run.row.begun_at), html_text(lesson_title(lessons, result.lesson)),
      mode_words(result, pause), result.shifts.size(),
      is_graded(result) ? fmt::format("{:.1f}", result.grade) : std::string("–"), outcome(result), faults_list(result),
      comments_list(run.comments));
}

}  // namespace

std::string runs_section(const LearnerHistory& history, std::span<const Lesson> lessons) {
  if (history.runs.empty()) return section("runs", "Runs", paragraph("There is none yet."));
  std::string table =
      "<table class=\"runs\">\n<thead><tr><th class=\"number\">Run</th><th>Day</th><th>Lesson</th>"
      "<th class=\"number\">Shifts</th><th class=\"number\">Grade</th><th>Result</th>"
      "<th>What was seen, and what the instructor says</th></tr></thead>\n<tbody>\n";
  std::map<std::int64_t, double> pauses = retention_pauses(history);
  for (auto run = history.runs.rbegin(); run != history.runs.rend(); ++run)
    table += run_row(*run, lessons, pauses[run->row.id]);
  return section("runs", "Runs, newest first", table + "</tbody></table>\n");
}

}  // namespace gearshift
