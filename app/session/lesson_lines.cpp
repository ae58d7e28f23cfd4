#include "app/session/lesson_lines.h"

#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/lessons/assessment/grade.h"
#include "haptics/files/ascii.h"

namespace gearshift::session {
namespace {

// Removes the first two words from a text like "Not graded: the lever was guiding you." and capitalises the rest.
std::string without_verdict(std::string why) {
  constexpr std::string_view kVerdict = "Not graded: ";
  if (!why.starts_with(kVerdict)) return why;
  why.erase(0, kVerdict.size());
  if (!why.empty()) why[0] = haptics::ascii_upper(why[0]);
  return why;
}

std::string format_result(const lessons::LessonResult& result) {
  if (!lessons::is_graded(result)) return "not graded. " + without_verdict(result.why);
  const std::string grade = fmt::format("grade {:.1f}/10, ", result.grade);
  return grade + (result.passed ? "passed" : "not passed. " + result.why);
}

// True once the trial has cycles. The duration is checked too, because on the virtual clock a trial may begin at 0 s.
bool has_cycles(const lessons::LessonResult& result) {
  return result.begin != 0.0 || result.duration > 0.0;
}

}  // namespace

std::vector<std::string> LessonLines::new_lines(const lessons::CoachView& coach) {
  lines_.clear();
  const lessons::LessonPhase before = std::exchange(phase_, coach.phase);
  const bool has_trial = phase_ == lessons::LessonPhase::driving || phase_ == lessons::LessonPhase::over;
  if (!has_trial && std::exchange(is_running_, false)) lines_.push_back(fmt::format("lesson {} ended early", lesson_));
  if (phase_ == lessons::LessonPhase::offered && before != phase_)
    lines_.push_back(fmt::format("lesson {} is ready to start: {}", coach.lesson, coach.goal));
  if (!has_trial || !has_cycles(*coach.result)) return lines_;
  const bool fresh = phase_ == lessons::LessonPhase::driving && !is_running_;
  if (fresh || is_new_trial(*coach.result)) begin(coach);
  duration_ = coach.result->duration;
  if (coach.now->step != step_) add_step_line(coach);
  add_hint_lines(coach);
  if (phase_ == lessons::LessonPhase::over && std::exchange(is_running_, false))
    lines_.push_back(fmt::format("lesson {} is over: {}", coach.lesson, format_result(*coach.result)));
  return lines_;
}

// True if this result is the first one of a trial, even if the previous trial ended within the same frame.
bool LessonLines::is_new_trial(const lessons::LessonResult& result) const {
  return result.begin != begin_ || result.duration < duration_;
}

void LessonLines::begin(const lessons::CoachView& coach) {
  if (is_running_) lines_.emplace_back("previous attempt ended early");
  lesson_ = coach.lesson;
  begin_ = coach.result->begin;
  is_running_ = true;
  hints_ = 0;
  lines_.push_back(fmt::format("lesson {} begins", coach.lesson));
  add_step_line(coach);
}

void LessonLines::add_step_line(const lessons::CoachView& coach) {
  step_ = coach.now->step;
  if (step_ < coach.now->steps)
    lines_.push_back(fmt::format("step {} of {}: {}", step_ + 1, coach.now->steps, coach.now->prompt));
}

void LessonLines::add_hint_lines(const lessons::CoachView& coach) {
  for (; hints_ < coach.now->feedback.size(); ++hints_) lines_.push_back(coach.now->feedback[hints_]);
}

void print_lines(const std::vector<std::string>& lines, double time) {
  for (const std::string& line : lines) base::print_out("{:8.3f} s  {}\n", time, line);
  if (!lines.empty()) std::fflush(stdout);
}

}  // namespace gearshift::session
