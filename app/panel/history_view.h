// What a learner has driven: every run, its shifts, its faults, and what the instructor says of it.
#pragma once

#include <cstdint>

#include "app/panel/comment_list.h"
#include "app/panel/panel.h"

namespace gearshift {

class HistoryView {
 public:
  void draw(Controls& controls, const CoachView& coach, PanelRequests& out);

 private:
  void draw_run(Controls& controls, const CoachView& coach, const RunRow& run);
  void draw_opened(Controls& controls, const RunRow& run, const std::vector<CommentRow>& comments, PanelRequests& out);

  std::int64_t opened_ = 0;  // RunRow::id; 0: none
  CommentList comments_;     // of that run
};

}  // namespace gearshift
