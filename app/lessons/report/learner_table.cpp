#include "app/lessons/report/learner_table.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/standing.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

std::string format_next_lesson(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const NextLesson next = next_lesson(history, lessons);
  if (next.lesson.empty()) return "-";
  return haptics::printable(next.lesson) + (next.by_instructor ? " (chosen by the instructor)" : "");
}

// Lists the comments with the numbers needed to edit them. Line breaks within a comment become blanks.
std::string comment_lines(const LearnerHistory& history) {
  std::string lines;
  for (auto run = history.runs.rbegin(); run != history.runs.rend(); ++run) {
    for (const CommentRow& comment : run->comments)
      lines += fmt::format("{:>5}  comment {}, {}, {}{}: {}\n", run->id, comment.id, haptics::printable(comment.author),
                           haptics::printable(day_of(comment.at)), comment.edited_at.empty() ? "" : ", edited",
                           haptics::printable(comment.text));
  }
  return lines.empty() ? lines : "\n" + lines;
}

}  // namespace

std::string learner_table(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons) {
  constexpr std::string_view kHead = "learner";
  std::size_t width = kHead.size();
  const auto name_of = [](const LearnerHistory& history) { return haptics::printable(history.learner.name); };
  for (const LearnerHistory& history : learners) width = std::max(width, text_columns(name_of(history)));
  const auto padded = [&](const std::string& text) { return text + std::string(width - text_columns(text), ' '); };
  std::string table = padded(std::string(kHead)) + "  sessions  runs  last day    next lesson\n";
  for (const LearnerHistory& history : learners) {
    const Totals sum = totals(history);
    table += fmt::format("{}  {:>8}  {:>4}  {:<10}  {}\n", padded(name_of(history)), sum.sessions, sum.runs,
                         sum.last_day.empty() ? "-" : haptics::printable(sum.last_day),
                         format_next_lesson(history, lessons));
  }
  return table;
}

std::string run_table(const LearnerHistory& history) {
  std::string table =
      fmt::format("{:>5}  {:<10}  {:<24}  {:<14}  {:>5}  result\n", "run", "day", "lesson", "mode", "grade");
  for (auto run = history.runs.rbegin(); run != history.runs.rend(); ++run) {
    const LessonResult& result = run->result;
    table += fmt::format("{:>5}  {:<10}  {:<24}  {:<14}  {:>5}  {}\n", run->id,
                         haptics::printable(day_of(run->begun_at)), haptics::printable(result.lesson),
                         result.mode == LessonMode::follow_me ? "follow me" : "do it yourself",
                         is_graded(result) ? fmt::format("{:.1f}", result.grade) : "-",
                         result.passed       ? "passed"
                         : is_graded(result) ? "not passed"
                                             : "not graded");
  }
  return table + comment_lines(history);
}

}  // namespace gearshift::lessons
