#include "app/lessons/assessment/suggest.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/core.h>

namespace gearshift::lessons {
namespace {

constexpr int kLastResults = 3;  // engineering value

bool was_passed(std::span<const GradedTrial> past, std::string_view lesson) {
  return std::any_of(past.begin(), past.end(), [&](const GradedTrial& r) { return r.passed && r.lesson == lesson; });
}

bool is_weaker(const RecentResults& a, const RecentResults& b) noexcept {
  const int more = a.failed * b.runs - b.failed * a.runs;  // compares the fractions of failed runs
  return more != 0 ? more > 0 : a.grade < b.grade;
}

// Returns the weakest of the lessons that `counts` accepts, or null.
const Lesson* weakest(std::span<const Lesson> lessons, std::span<const GradedTrial> past, const auto& counts) {
  const Lesson* found = nullptr;
  RecentResults lowest;
  for (const Lesson& lesson : lessons) {
    const std::optional<RecentResults> form = recent_results(past, lesson.task);
    if (!form || !counts(*form) || (found != nullptr && !is_weaker(*form, lowest))) continue;
    found = &lesson;
    lowest = *form;
  }
  return found;
}

const Lesson* find_lesson(std::span<const Lesson> lessons, const auto& is_wanted) {
  const auto found = std::find_if(lessons.begin(), lessons.end(), is_wanted);
  return found == lessons.end() ? nullptr : &*found;
}

std::string never_passed_text(const Lesson& lesson, std::span<const GradedTrial> past,
                              std::span<const UngradedTrial> others) {
  const std::string tried = tries_text(count_tries(past, others, lesson.task));
  return fmt::format("You haven't passed {} yet{}.", lesson.title, tried.empty() ? "" : " (" + tried + ")");
}

std::string weak_lesson_text(const Lesson& lesson, const RecentResults& form) {
  return fmt::format("{} needs practice: {} of the last {} attempts failed, the latest one too (recent grade {:.1f}).",
                     lesson.title, form.failed, form.runs, form.grade);
}

constexpr std::int64_t kDay = 24 * 3600;  // [s]

bool is_retention_test(const GradedTrial& trial) noexcept {
  return trial.pause >= static_cast<double>(kTestDue);
}

// True if the trial had another car or gate than the lesson's first one. Old runs do not name theirs.
bool is_transfer(std::span<const GradedTrial> past, const GradedTrial& trial) {
  const auto is_known = [&](const GradedTrial& t) { return t.lesson == trial.lesson && !t.car.empty(); };
  const auto first = std::find_if(past.begin(), past.end(), is_known);
  return first != past.end() && is_known(trial) && (trial.car != first->car || trial.path_length != first->path_length);
}

// The day's test is done: a retention or transfer test was driven on this day (UTC).
bool was_tested_on(std::span<const GradedTrial> past, std::int64_t day) {
  return std::any_of(past.begin(), past.end(), [&](const GradedTrial& trial) {
    return trial.begun && *trial.begun / kDay == day && (is_retention_test(trial) || is_transfer(past, trial));
  });
}

// Time since the lesson was last driven [s]; 0 if it is not confirmed or the time is unknown.
std::int64_t idle_time(std::span<const GradedTrial> past, const Lesson& lesson, std::int64_t now) {
  if (!was_confirmed(past, lesson.key, &GradedTrial::lesson)) return 0;
  const auto is_lesson = [&](const GradedTrial& trial) { return trial.lesson == lesson.key; };
  const auto last = std::find_if(past.rbegin(), past.rend(), is_lesson);
  return last != past.rend() && last->begun ? now - *last->begun : 0;
}

std::optional<Suggestion> due_retention(std::span<const Lesson> lessons, std::span<const GradedTrial> past,
                                        std::int64_t now) {
  const Lesson* longest = nullptr;
  std::int64_t idle = kTestDue - 1;
  for (const Lesson& lesson : lessons)
    if (const std::int64_t time = idle_time(past, lesson, now); time > idle) longest = &lesson, idle = time;
  if (longest == nullptr) return std::nullopt;
  return Suggestion{longest->key, fmt::format("You last drove {} {} days ago. Drive it once without help, as a test of "
                                              "what you remember.",
                                              longest->title, idle / kDay)};
}

// A lesson whose retention test was passed, always with the same car and gate.
std::optional<Suggestion> due_transfer(std::span<const Lesson> lessons, std::span<const GradedTrial> past) {
  for (const Lesson& lesson : lessons) {
    bool has_kept = false, has_transfer = false;
    for (const GradedTrial& trial : past) {
      if (trial.lesson != lesson.key) continue;
      has_kept = has_kept || (trial.passed && is_retention_test(trial));
      has_transfer = has_transfer || is_transfer(past, trial);
    }
    if (has_kept && !has_transfer)
      return Suggestion{lesson.key,
                        fmt::format("You passed {} after a long break. Drive it with another car or gate, as "
                                    "a test of whether you can do it there, too.",
                                    lesson.title)};
  }
  return std::nullopt;
}

std::optional<Suggestion> due_test(std::span<const Lesson> lessons, std::span<const GradedTrial> past,
                                   std::int64_t now) {
  if (was_tested_on(past, now / kDay)) return std::nullopt;
  if (std::optional<Suggestion> retention = due_retention(lessons, past, now)) return retention;
  return due_transfer(lessons, past);
}

}  // namespace

bool is_weak(const RecentResults& form) noexcept {
  return form.failed_last && 2 * form.failed >= form.runs;
}

bool was_confirmed(std::span<const GradedTrial> past, std::string_view name, std::string GradedTrial::*of) {
  const auto is_pass = [&](const GradedTrial& trial) { return trial.passed && trial.*of == name; };
  const auto first = std::find_if(past.begin(), past.end(), is_pass);
  bool has_other = false;
  for (auto trial = first; trial != past.end(); ++trial) {
    has_other = has_other || (*trial).*of != name;
    if (trial != first && is_pass(*trial) &&
        (has_other || trial->begun_at.substr(0, 10) != first->begun_at.substr(0, 10)))
      return true;
  }
  return false;
}

std::optional<RecentResults> recent_results(std::span<const GradedTrial> past, std::string_view task) {
  RecentResults form;
  double weights = 0.0;
  for (std::size_t i = past.size(); i > 0 && form.runs < kLastResults; --i) {
    const GradedTrial& trial = past[i - 1];
    if (trial.task != task) continue;
    if (form.runs == 0) form.failed_last = !trial.passed;
    const double weight = kLastResults - form.runs;
    ++form.runs;
    form.failed += trial.passed ? 0 : 1;
    form.grade += weight * trial.grade;
    weights += weight;
  }
  if (form.runs == 0) return std::nullopt;
  form.grade /= weights;
  return form;
}

Tries count_tries(std::span<const GradedTrial> past, std::span<const UngradedTrial> others, std::string_view task) {
  Tries tries;
  for (const GradedTrial& trial : past) {
    if (trial.task == task) ++(trial.passed ? tries.passed : tries.failed);
  }
  for (const UngradedTrial& trial : others) {
    if (trial.task == task) ++(trial.was_left ? tries.given_up : trial.was_guided ? tries.guided : tries.cut_off);
  }
  return tries;
}

std::string tries_text(const Tries& tries) {
  std::string text;
  for (const auto& [count, label] : {std::pair(tries.failed, "failed"),
                                     {tries.guided, "guided"},
                                     {tries.given_up, "given up"},
                                     {tries.cut_off, "cut off"}}) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, label);
  }
  return text;
}

std::optional<Suggestion> suggest_lesson(std::span<const Lesson> lessons, std::span<const GradedTrial> past,
                                         std::span<const UngradedTrial> others, std::optional<std::int64_t> now) {
  if (lessons.empty()) return std::nullopt;
  if (now)
    if (std::optional<Suggestion> test = due_test(lessons, past, *now)) return test;
  if (const Lesson* lesson = find_lesson(lessons, [&](const Lesson& l) { return !was_passed(past, l.key); }))
    return Suggestion{lesson->key, never_passed_text(*lesson, past, others)};
  if (const Lesson* lesson = weakest(lessons, past, is_weak))
    return Suggestion{lesson->key, weak_lesson_text(*lesson, *recent_results(past, lesson->task))};
  if (const Lesson* lesson = find_lesson(lessons, [&](const Lesson& l) { return !was_confirmed(past, l.task); }))
    return Suggestion{lesson->key, fmt::format("You have passed {} once; pass it again to be sure.", lesson->title)};
  const Lesson* lesson = weakest(lessons, past, [](const RecentResults&) { return true; });
  return Suggestion{lesson->key,
                    fmt::format("You have passed all lessons twice; {} is the weakest, with a recent grade of {:.1f}.",
                                lesson->title, recent_results(past, lesson->task)->grade)};
}

}  // namespace gearshift::lessons
