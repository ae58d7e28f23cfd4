// A lesson, below the cabin: its goal, then its prompts and what was done wrong, then its result and what comes next.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "app/panel/panel.h"

namespace gearshift {

class LessonCard {
 public:
  // Along the lower edge of that room [px]; returns its upper edge: the room's lower one where no lesson is chosen, or
  // no word has room. As high in every phase of a lesson: higher only where a text would not fit. Where the panel is
  // hidden it tells of the car, too.
  double draw(Controls& controls, const PanelInput& input, bool panel_shown, const ControlRect& room,
              PanelRequests& out);

 private:
  struct Now {  // of a frame
    Controls& controls;
    const PanelInput& input;
    const CoachView& coach;
    bool panel_shown, forces_off;
    PanelRequests& out;
  };
  void follow(const CoachView& coach, ImVec2 size);
  void listen(const CoachView& coach);
  template <class Body, class Foot>
  void draw_parts(LessonPhase phase, const Body& body, const Foot& foot);
  void draw_offered(Now& now);
  void draw_driving(Now& now);
  float draw_prompts(Now& now);
  void draw_said(const std::vector<std::string>& said, float& must);
  void draw_over(Now& now);
  static void draw_helps(const Now& now);

  std::size_t said_ = 0;         // sentences that have been seen
  double said_at_ = -1e9;        // [s] on the frames' clock, the newest of them
  std::string lesson_;           // that the heights belong to
  ImVec2 size_{0.0f, 0.0f};      // [px] of card at the least, likewise
  float needed_ = 0.0f;          // [px] most that this lesson's texts have needed
  std::array<float, 4> foot_{};  // [px] below the texts, by phase
};

}  // namespace gearshift
