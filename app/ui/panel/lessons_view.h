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
  void apply_name(const lessons::CoachView& coach, const std::string& name, PanelCommands& out);
  void draw_known(Controls& controls, const lessons::CoachView& coach, float width, PanelCommands& out);
  void draw_question(Controls& controls, PanelCommands& out);

  std::array<char, lessons::kMaxNameBytes + 1> name_{};  // the text field
  std::string shown_;                                    // learner whose name was last copied into the field
  // A name that means a known learner is not applied at once, because two people may have one name: `asked_` is this
  // learner while the question is open, `refused_` after the answer "No".
  std::string asked_, refused_;
  bool is_renaming_ = false;  // the field holds the current learner's new name
  bool takes_keyboard_ = false;
};

}  // namespace gearshift::ui
