// The learner, all lessons with the learner's progress, and the next lesson.
#pragma once

#include <array>
#include <string>

#include "app/lessons/history/user_text.h"
#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class LessonsView {
 public:
  // is_automatic_hand: the simulated driver is driving, so nothing is saved for the learner.
  void draw(Controls& controls, const lessons::CoachView& coach, bool is_automatic_hand, PanelCommands& out);

 private:
  void draw_learner(Controls& controls, const lessons::CoachView& coach, bool is_automatic_hand, PanelCommands& out);

  std::array<char, lessons::kMaxNameBytes + 1> name_{};  // the text field
  std::string shown_;                                    // learner whose name was last copied into the field
};

}  // namespace gearshift::ui
