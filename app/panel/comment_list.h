// What the instructor says of a run: said, said otherwise, taken back.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/history/typed_text.h"
#include "app/panel/panel.h"

namespace gearshift {

class CommentList {
 public:
  void draw(Controls& controls, std::int64_t run, const std::vector<CommentRow>& comments, LessonRequests& out);

 private:
  enum class Change { none, edits, deletes };

  void draw_comment(Controls& controls, std::int64_t run, const CommentRow& comment, LessonRequests& out);
  void draw_buttons(Controls& controls, const CommentRow& comment);
  void draw_edit(Controls& controls, std::int64_t run, LessonRequests& out);
  void draw_delete(Controls& controls, std::int64_t run, LessonRequests& out);
  void draw_field(Controls& controls, std::int64_t run, LessonRequests& out);

  Change change_ = Change::none;
  std::int64_t changed_ = 0;  // CommentRow::id
  std::array<char, kLongestComment + 1> edited_{};
  std::array<char, kLongestName + 1> author_{};
  std::array<char, kLongestComment + 1> text_{};
};

}  // namespace gearshift
