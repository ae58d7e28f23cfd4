// Who learns, all lessons and how this learner stands in them, and which one comes next.
#pragma once

#include <array>
#include <string>

#include "app/history/typed_text.h"
#include "app/panel/panel.h"

namespace gearshift {

class LessonsView {
 public:
  // by_itself: the hand needs nobody, whoever was chosen.
  void draw(Controls& controls, const CoachView& coach, bool by_itself, LessonRequests& out);

 private:
  void draw_learner(Controls& controls, const CoachView& coach, bool by_itself, LessonRequests& out);

  std::array<char, kLongestName + 1> name_{};  // as it is written
  std::string shown_;                          // the learner that it was filled with
};

}  // namespace gearshift
