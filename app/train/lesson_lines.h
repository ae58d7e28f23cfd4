// What the coach tells, as lines on stdout: for people and scripts that watch.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/coach/coach_view.h"

namespace gearshift {

class LessonLines {
 public:
  // Once a frame: what is new.
  std::vector<std::string> news(const CoachView& coach);

 private:
  bool is_another(const LessonResult& result) const;
  void begin(const CoachView& coach);
  void tell_step(const CoachView& coach);
  void tell_said(const CoachView& coach);

  std::vector<std::string> lines_;
  LessonPhase phase_ = LessonPhase::none;
  std::string lesson_;               // that is told, by its key
  std::optional<double> begin_;      // [s] of its trial
  double duration_ = 0.0;            // [s] so far
  bool driven_ = false;              // it is not over
  std::size_t step_ = 0, said_ = 0;  // that have been told
};

void print_lines(const std::vector<std::string>& lines, double time);  // [s] since the start of the session

}  // namespace gearshift
