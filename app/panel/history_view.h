// What a learner has driven: every run, its shifts, its faults, and what the instructor says of it.
#pragma once

#include <array>
#include <cstdint>

#include "app/panel/panel.h"

namespace gearshift {

class HistoryView {
 public:
  void draw(Controls& controls, const CoachView& coach, PanelRequests& out);

 private:
  void draw_run(Controls& controls, const CoachView& coach, const RunRow& run);
  void draw_opened(Controls& controls, const RunRow& run, const std::vector<CommentRow>& comments, PanelRequests& out);
  void draw_comment_field(Controls& controls, const RunRow& run, LessonRequests& out);

  std::int64_t opened_ = 0;  // RunRow::id; 0: none
  std::array<char, 64> author_{};
  std::array<char, 400> text_{};
};

}  // namespace gearshift
