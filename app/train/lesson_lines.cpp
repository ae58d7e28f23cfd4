#include "app/train/lesson_lines.h"

#include <cstdio>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace gearshift {
namespace {

void line(double time, const std::string& words) {
  fmt::print("{:8.3f} s  {}\n", time, words);
  std::fflush(stdout);
}

std::string result_words(const LessonResult& result) {
  if (result.guided) return "guided, not graded";
  const std::string grade = fmt::format("grade {:.1f} of 10, ", result.grade);
  return grade + (result.passed ? "passed" : "not passed: " + result.why);
}

}  // namespace

void LessonLines::print(const CoachView& coach, double time) {
  const LessonPhase before = std::exchange(phase_, coach.phase);
  const bool begins = phase_ == LessonPhase::driving && (before != phase_ || coach.now.step < step_);
  if (phase_ == LessonPhase::offered && before != phase_)
    line(time, fmt::format("lesson {} is offered: {}", coach.lesson, coach.goal));
  if (begins) {
    step_ = said_ = 0;
    line(time, fmt::format("lesson {} begins", coach.lesson));
    print_step(coach, time);
  }
  if (phase_ != LessonPhase::driving && phase_ != LessonPhase::over) return;
  if (coach.now.step != step_) print_step(coach, time);
  print_said(coach, time);
  if (phase_ == LessonPhase::over && before != phase_)
    line(time, fmt::format("lesson {} is over: {}", coach.lesson, result_words(coach.result)));
}

void LessonLines::print_step(const CoachView& coach, double time) {
  step_ = coach.now.step;
  if (step_ < coach.now.steps)
    line(time, fmt::format("step {} of {}: {}", step_ + 1, coach.now.steps, coach.now.prompt));
}

void LessonLines::print_said(const CoachView& coach, double time) {
  for (; said_ < coach.now.said.size(); ++said_) line(time, coach.now.said[said_]);
}

}  // namespace gearshift
