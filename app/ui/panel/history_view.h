// A learner's history: every run with its shifts, driving errors and the instructor's comments.
#pragma once

#include <cstdint>
#include <span>

#include "app/ui/panel/comment_list.h"
#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class HistoryView {
 public:
  void draw(Controls& controls, const lessons::CoachView& coach, PanelCommands& out);

 private:
  void draw_runs(Controls& controls, const lessons::CoachView& coach, std::span<const lessons::RunRow> runs);
  void draw_run(Controls& controls, const lessons::CoachView& coach, const lessons::RunRow& run);
  void draw_opened(Controls& controls, const lessons::RunRow& run, PanelCommands& out);

  std::int64_t opened_ = 0;  // RunRow::id of the run whose details are shown; 0: none
  CommentList comments_;     // comments on the opened run
};

}  // namespace gearshift::ui
