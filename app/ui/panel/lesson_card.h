// The lesson card at the bottom of the cabin: first the goal, then prompts and driving errors, then the result and the
// next lesson.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class LessonCard {
 public:
  // Draws along the lower edge of `room` [px]. Returns the card's upper edge [px], or the lower edge of `room` if no
  // lesson is selected or no text fits. The height is the same in all phases of a lesson unless a text needs more.
  // While the panel is hidden, the card also shows the car's state. In the learner's view it is as low as its texts allow.
  double draw(Controls& controls, const PanelInput& input, PanelView view, const ControlRect& room, PanelCommands& out);

 private:
  struct FrameContext {
    Controls& controls;
    const PanelInput& input;
    const lessons::CoachView& coach;
    PanelView view;
    bool forces_off;
    PanelCommands& out;
  };
  void follow(const lessons::CoachView& coach, PanelView view, ImVec2 size);
  void note_new_feedback(const lessons::CoachView& coach);
  template <class Body, class Foot>
  void draw_parts(lessons::LessonPhase phase, const Body& body, const Foot& foot);
  void draw_offered(FrameContext& now);
  void draw_driving(FrameContext& now);
  float draw_prompts(FrameContext& now);
  void draw_feedback(const std::vector<std::string>& feedback, float& visible_height);
  void draw_over(FrameContext& now);
  static void draw_controls_and_car(const FrameContext& now);

  std::size_t feedback_count_ = 0;  // number of feedback sentences in the last frame
  double feedback_time_ = -1e9;     // [s] arrival of the newest sentence, on ImGui's clock
  std::string lesson_;              // the lesson that size_ and needed_ belong to
  std::size_t part_ = 0;            // what else they belong to: in the learner's view, phase and step
  ImVec2 size_{0.0f, 0.0f};         // [px] minimum size of the card
  float needed_ = 0.0f;             // [px] largest height that this lesson's texts have needed
  // [px] height of the controls below the texts, per phase of the lesson; empty: not drawn yet
  std::array<std::optional<float>, 4> foot_{};
};

}  // namespace gearshift::ui
