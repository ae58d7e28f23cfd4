#include "app/lessons/report/standing.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/history/graded_trials.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"

namespace gearshift::lessons {
namespace {

constexpr int kRecentRuns = 3;  // runs whose errors decide on the advice

Standing standing_of(std::span<const GradedTrial> past, const Tries& tries, std::string_view task) {
  if (tries.passed + tries.failed + tries.guided + tries.given_up + tries.cut_off == 0) return Standing::not_tried;
  const std::optional<RecentResults> recent = recent_results(past, task);
  if (!recent || recent->failed == recent->runs) return Standing::not_yet;
  return was_confirmed(past, task) && !is_weak(*recent) ? Standing::can : Standing::nearly;
}

std::string times(int count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

// The runs without a grade, as the end of a sentence.
std::string also(Tries tries) {
  tries.failed = 0;
  const std::string others = tries_text(tries);
  return others.empty() ? others : "; also " + others;
}

std::string sentence_of(Standing standing, std::span<const GradedTrial> past, const Tries& tries,
                        std::string_view task) {
  if (standing == Standing::not_tried) return {};
  const int graded = tries.passed + tries.failed;
  if (graded == 0) return fmt::format("No graded attempt yet: {}.", tries_text(tries));
  const GradedTrial& last =
      *std::find_if(past.rbegin(), past.rend(), [&](const GradedTrial& trial) { return trial.task == task; });
  std::string text;
  if (standing == Standing::can)
    text = fmt::format("Passed {} of {} graded attempts; the last, on {}, got {:.1f}", tries.passed, graded,
                       day_of(last.begun_at), last.grade);
  else if (tries.passed == 0)
    text = fmt::format("Not passed in {} graded attempt{}; the last, on {}, got {:.1f}", graded, graded == 1 ? "" : "s",
                       day_of(last.begun_at), last.grade);
  else if (standing == Standing::not_yet)
    text = fmt::format("Passed {}, but in none of the latest attempts", times(tries.passed));
  else if (!was_confirmed(past, task))
    text = fmt::format("Passed {}, but not yet again on another day or after another lesson", times(tries.passed));
  else
    text = fmt::format("Passed {} of {} graded attempts, but not the last one", tries.passed, graded);
  return text + also(tries) + ".";
}

// The advice on the kind of error that weighed most in the task's latest runs, guided or not.
std::string error_advice_for(const LearnerHistory& history, std::string_view task) {
  std::array<double, kErrorKindCount> points{};
  int runs = 0;
  for (auto run = history.runs.rbegin(); run != history.runs.rend() && runs < kRecentRuns; ++run) {
    if (run->result.task != task || run->result.end == LessonEnd::running) continue;
    ++runs;
    for (const DrivingError& error : run->result.errors)
      points[static_cast<std::size_t>(error.kind)] += points_of(error.severity);
  }
  const auto most = std::max_element(points.begin(), points.end());
  if (*most == 0.0) return {};
  const auto kind = static_cast<ErrorKind>(most - points.begin());
  return fmt::format("{}: {}", title_from_key(to_string(kind)), error_advice(kind));
}

// The advice on the figure that failed the task's latest run; empty if something else did, or if it was passed.
std::string figure_advice_for(const LearnerHistory& history, std::span<const Lesson> lessons, std::string_view task) {
  const auto last = std::find_if(history.runs.rbegin(), history.runs.rend(),
                                 [&](const RunRow& run) { return run.result.task == task && is_graded(run.result); });
  if (last == history.runs.rend() || last->result.passed || last->result.score.value_or(0.0) <= 1.0) return {};
  const auto lesson =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == last->result.lesson; });
  const Norm* norm = lesson != lessons.end() ? norm_of(*lesson, last->result.mode) : nullptr;
  if (norm == nullptr) return {};
  const std::string_view mend = thing_to_mend(*lesson, last->result, norm);
  return mend.empty() ? std::string() : fmt::format("To mend: {}", mend);
}

std::string advice_for(const LearnerHistory& history, std::span<const Lesson> lessons, Standing standing,
                       const Tries& tries, std::string_view task) {
  if (standing == Standing::not_tried || standing == Standing::can) return {};
  if (std::string advice = figure_advice_for(history, lessons, task); !advice.empty()) return advice;
  if (std::string advice = error_advice_for(history, task); !advice.empty()) return advice;
  if (tries.passed + tries.failed == 0) return "Drive it to the end once without guidance.";
  return standing == Standing::nearly ? "Drive it again on another day." : "Drive it again.";
}

}  // namespace

std::string_view to_string(Standing standing) noexcept {
  constexpr std::string_view kNames[] = {"not tried", "not yet", "nearly", "can"};
  return kNames[static_cast<std::size_t>(standing)];
}

std::vector<TaskStanding> task_standings(const LearnerHistory& history, std::span<const Lesson> lessons) {
  std::vector<std::string> tasks;
  const auto add = [&](const std::string& task) {
    if (std::find(tasks.begin(), tasks.end(), task) == tasks.end()) tasks.push_back(task);
  };
  for (const Lesson& lesson : lessons) add(lesson.task);
  for (const RunRow& run : history.runs) add(run.result.task);
  const std::vector<GradedTrial> past = graded_trials(history.runs);
  const std::vector<UngradedTrial> others = ungraded_trials(history.runs);
  std::vector<TaskStanding> standings;
  for (const std::string& task : tasks) {
    const Tries tries = count_tries(past, others, task);
    const Standing standing = standing_of(past, tries, task);
    standings.push_back({task, standing, sentence_of(standing, past, tries, task),
                         advice_for(history, lessons, standing, tries, task)});
  }
  return standings;
}

NextLesson next_lesson(const LearnerHistory& history, std::span<const Lesson> lessons) {
  if (is_lesson(lessons, history.learner.next_lesson))
    return {history.learner.next_lesson, "Chosen by the instructor.", true};
  const Suggestion next =
      suggest_lesson(lessons, graded_trials(history.runs), ungraded_trials(history.runs), history.now)
          .value_or(Suggestion{});
  return {next.lesson, next.why};
}

}  // namespace gearshift::lessons
