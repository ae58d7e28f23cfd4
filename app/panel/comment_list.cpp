#include "app/panel/comment_list.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "app/panel/lesson_words.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr float kEditLines = 4.0f;

// Why it cannot be taken, below its field; nothing for an empty one, which nobody has begun.
bool is_taken(TypedText kind, const char* what, const char* text) {
  if (*text == '\0') return false;
  const std::string problem = typed_text_problem(kind, what, text);
  if (!problem.empty()) put_wrapped(problem, ink::kWarn);
  return problem.empty();
}

bool quiet(Controls& controls, const std::string& name, const char* label) {
  const WithFont small(UiFont::small);
  return controls.button(name.c_str(), label);
}

}  // namespace

void CommentList::draw(Controls& controls, std::int64_t run, const std::vector<CommentRow>& comments,
                       LessonRequests& out) {
  for (const CommentRow& comment : comments) draw_comment(controls, run, comment, out);
  draw_field(controls, run, out);
}

void CommentList::draw_comment(Controls& controls, std::int64_t run, const CommentRow& comment, LessonRequests& out) {
  const bool changes = change_ != Change::none && changed_ == comment.id;
  const std::string when = local_time_words(comment.at) + (comment.edited_at.empty() ? "" : ", edited");
  put(comment.author, ink::kAccent, UiFont::small);
  beside(width_of(when, UiFont::small));
  put(when, ink::kSoft, UiFont::small);
  if (!changes) draw_buttons(controls, comment);
  if (changes && change_ == Change::edits) return draw_edit(controls, run, out);
  put_wrapped(comment.text, ink::kText);
  if (changes) draw_delete(controls, run, out);
}

void CommentList::draw_buttons(Controls& controls, const CommentRow& comment) {
  {
    const WithFont small(UiFont::small);
    at_right(button_width("edit") + button_width("delete") + ImGui::GetStyle().ItemSpacing.x);
  }
  if (quiet(controls, fmt::format("comment_edit: {}", comment.id), "edit")) {
    change_ = Change::edits;
    changed_ = comment.id;
    std::snprintf(edited_.data(), edited_.size(), "%s", comment.text.c_str());
  }
  ImGui::SameLine();
  if (quiet(controls, fmt::format("comment_delete: {}", comment.id), "delete")) {
    change_ = Change::deletes;
    changed_ = comment.id;
  }
}

void CommentList::draw_edit(Controls& controls, std::int64_t run, LessonRequests& out) {
  ImGui::InputTextMultiline("##comment_text", edited_.data(), edited_.size(),
                            {ImGui::GetContentRegionAvail().x, kEditLines * ImGui::GetTextLineHeightWithSpacing()});
  controls.mark("comment_text");
  ImGui::BeginDisabled(!is_taken(TypedText::comment, "a comment", edited_.data()));
  if (quiet(controls, "comment_save", "Save")) {
    out.comment_change = {run, changed_, edited_.data()};
    change_ = Change::none;
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (quiet(controls, "comment_cancel", "Cancel")) change_ = Change::none;
}

// Asked twice: it cannot be had back.
void CommentList::draw_delete(Controls& controls, std::int64_t run, LessonRequests& out) {
  const WithFont small(UiFont::small);
  if (controls.button("comment_delete_sure", "Delete for good", {0.0f, 0.0f}, ink::kBadDeep)) {
    out.comment_change = {run, changed_, std::nullopt};
    change_ = Change::none;
  }
  ImGui::SameLine();
  if (controls.button("comment_cancel", "Keep")) change_ = Change::none;
}

void CommentList::draw_field(Controls& controls, std::int64_t run, LessonRequests& out) {
  const float em = ui_em(), button = button_width("Add");
  ImGui::SetNextItemWidth(std::min(9.0f * em, ImGui::GetContentRegionAvail().x));
  ImGui::InputTextWithHint("##author", "your name", author_.data(), author_.size());
  controls.mark("comment_author");
  const bool named = is_taken(TypedText::name, "your name", author_.data());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool entered = ImGui::InputTextWithHint("##comment", "a comment beside the grade", text_.data(), text_.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  controls.mark("comment");
  ImGui::SameLine();
  const bool said = typed_text_problem(TypedText::comment, "a comment", text_.data()).empty();
  ImGui::BeginDisabled(!named || !said);
  const bool pressed = controls.button("comment_add", "Add");
  ImGui::EndDisabled();
  (void)is_taken(TypedText::comment, "a comment", text_.data());
  if (!(entered || pressed) || !named || !said) return;
  out.comment = {run, author_.data(), text_.data()};
  text_.fill('\0');
}

}  // namespace gearshift
