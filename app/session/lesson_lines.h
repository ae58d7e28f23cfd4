// Turns the progress of a lesson into lines on stdout, for users and scripts that follow the lesson.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/lessons/coach/coach_view.h"

namespace gearshift::session {

class LessonLines {
 public:
  // Call once per frame. Returns the new lines of this frame.
  std::vector<std::string> new_lines(const lessons::CoachView& coach);

 private:
  bool is_new_trial(const lessons::LessonResult& result) const;
  void begin(const lessons::CoachView& coach);
  void add_step_line(const lessons::CoachView& coach);
  void add_hint_lines(const lessons::CoachView& coach);

  std::vector<std::string> lines_;
  lessons::LessonPhase phase_ = lessons::LessonPhase::none;
  std::string lesson_;           // key of the lesson being reported
  std::optional<double> begin_;  // [s] start of the trial being reported
  double duration_ = 0.0;        // [s] duration of the trial so far
  bool is_running_ = false;
  std::size_t step_ = 0, hints_ = 0;  // step and number of hints already printed
};

void print_lines(const std::vector<std::string>& lines, double time);  // time [s] since session start

}  // namespace gearshift::session
