// A lesson, over the cabin: its goal, then its prompts and what was done wrong, then its result and what comes next.
#pragma once

#include <cstddef>

#include "app/panel/panel.h"

namespace gearshift {

class LessonCard {
 public:
  // Hanging from the top of that room [px], in its middle; nothing where no lesson is chosen, or no word has room.
  void draw(Controls& controls, const CoachView& coach, const ControlRect& room, LessonRequests& out);

 private:
  void listen(const CoachView& coach);
  void draw_offered(Controls& controls, const CoachView& coach, LessonRequests& out);
  void draw_driving(Controls& controls, const CoachView& coach, LessonRequests& out);
  void draw_said(const std::vector<std::string>& said);
  void draw_over(Controls& controls, const CoachView& coach, LessonRequests& out);
  void draw_faults(const LessonResult& result);

  std::size_t said_ = 0;        // sentences that have been seen
  double said_at_ = -1e9;       // [s] on the frames' clock, the newest of them
  float most_list_ = 0.0f;      // [px] that the faults may take
  float faults_height_ = 0.0f;  // [px] that they took
};

}  // namespace gearshift
