// Lines on stdout of what the coach tells: for people and scripts that watch.
#pragma once

#include <cstddef>

#include "app/coach/coach_view.h"

namespace gearshift {

class LessonLines {
 public:
  void print(const CoachView& coach, double time);  // once a frame; [s] since the start of the session

 private:
  void print_step(const CoachView& coach, double time);
  void print_said(const CoachView& coach, double time);

  LessonPhase phase_ = LessonPhase::none;
  std::size_t step_ = 0, said_ = 0;  // that have been told
};

}  // namespace gearshift
