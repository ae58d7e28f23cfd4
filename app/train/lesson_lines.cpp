#include "app/train/lesson_lines.h"

#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "app/print_out.h"
#include "app/training/grade.h"

namespace gearshift {
namespace {

std::string result_words(const LessonResult& result) {
  const std::string grade = is_graded(result) ? fmt::format("grade {:.1f} of 10, ", result.grade) : "not graded, ";
  return grade + (result.passed ? "passed" : "not passed: " + result.why);
}

// The first one may be at 0 s, on a virtual clock.
bool has_cycles(const LessonResult& result) {
  return result.begin != 0.0 || result.duration > 0.0;
}

}  // namespace

std::vector<std::string> LessonLines::news(const CoachView& coach) {
  lines_.clear();
  const LessonPhase before = std::exchange(phase_, coach.phase);
  const bool has_trial = phase_ == LessonPhase::driving || phase_ == LessonPhase::over;
  if (!has_trial && std::exchange(driven_, false)) lines_.push_back(fmt::format("lesson {} was left", lesson_));
  if (phase_ == LessonPhase::offered && before != phase_)
    lines_.push_back(fmt::format("lesson {} is offered: {}", coach.lesson, coach.goal));
  if (!has_trial || !has_cycles(coach.result)) return lines_;
  const bool fresh = phase_ == LessonPhase::driving && !driven_;
  if (fresh || is_another(coach.result)) begin(coach);
  duration_ = coach.result.duration;
  if (coach.now.step != step_) tell_step(coach);
  tell_said(coach);
  if (phase_ == LessonPhase::over && std::exchange(driven_, false))
    lines_.push_back(fmt::format("lesson {} is over: {}", coach.lesson, result_words(coach.result)));
  return lines_;
}

// The next trial may follow within a frame.
bool LessonLines::is_another(const LessonResult& result) const {
  return result.begin != begin_ || result.duration < duration_;
}

void LessonLines::begin(const CoachView& coach) {
  if (driven_) lines_.emplace_back("that trial was left");
  lesson_ = coach.lesson;
  begin_ = coach.result.begin;
  driven_ = true;
  said_ = 0;
  lines_.push_back(fmt::format("lesson {} begins", coach.lesson));
  tell_step(coach);
}

void LessonLines::tell_step(const CoachView& coach) {
  step_ = coach.now.step;
  if (step_ < coach.now.steps)
    lines_.push_back(fmt::format("step {} of {}: {}", step_ + 1, coach.now.steps, coach.now.prompt));
}

void LessonLines::tell_said(const CoachView& coach) {
  for (; said_ < coach.now.said.size(); ++said_) lines_.push_back(coach.now.said[said_]);
}

void print_lines(const std::vector<std::string>& lines, double time) {
  for (const std::string& line : lines) print_out("{:8.3f} s  {}\n", time, line);
  if (!lines.empty()) std::fflush(stdout);
}

}  // namespace gearshift
