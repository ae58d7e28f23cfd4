// The instructor's comments on a run: add, edit, delete.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/lessons/history/user_text.h"
#include "app/ui/panel/panel.h"

namespace gearshift::ui {

class CommentList {
 public:
  void draw(Controls& controls, std::int64_t run, const std::vector<lessons::CommentRow>& comments, PanelCommands& out);

 private:
  enum class Change { none, edits, deletes };

  void draw_comment(Controls& controls, std::int64_t run, const lessons::CommentRow& comment, PanelCommands& out);
  void draw_buttons(Controls& controls, const lessons::CommentRow& comment);
  void draw_edit(Controls& controls, std::int64_t run, PanelCommands& out);
  void draw_delete(Controls& controls, std::int64_t run, PanelCommands& out);
  void draw_field(Controls& controls, std::int64_t run, PanelCommands& out);

  Change change_ = Change::none;
  std::int64_t changed_ = 0;  // CommentRow::id of the comment being edited
  std::array<char, lessons::kMaxCommentBytes + 1> edited_{};
  std::array<char, lessons::kMaxNameBytes + 1> author_{};
  std::array<char, lessons::kMaxCommentBytes + 1> text_{};
};

}  // namespace gearshift::ui
