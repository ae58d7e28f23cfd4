#include "app/ui/panel/comment_list.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

constexpr float kEditLines = 4.0f;

// Returns true if the text is valid. Otherwise shows the reason below the field, unless the field is empty.
bool is_accepted(lessons::UserText kind, const char* label, const char* text) {
  if (*text == '\0') return false;
  const std::string problem = lessons::user_text_problem(kind, label, text);
  if (!problem.empty()) put_wrapped(problem, ink::kWarn);
  return problem.empty();
}

bool comment_button(Controls& controls, const std::string& name, const char* label) {
  const engine::WithFont small(engine::UiFont::small);
  return controls.button(name.c_str(), label);
}

}  // namespace

void CommentList::draw(Controls& controls, std::int64_t run, const std::vector<lessons::CommentRow>& comments,
                       PanelCommands& out) {
  for (const lessons::CommentRow& comment : comments) draw_comment(controls, run, comment, out);
  draw_field(controls, run, out);
}

void CommentList::draw_comment(Controls& controls, std::int64_t run, const lessons::CommentRow& comment,
                               PanelCommands& out) {
  const bool changes = change_ != Change::none && changed_ == comment.id;
  const std::string when = format_local_time(comment.at) + (comment.edited_at.empty() ? "" : ", edited");
  put(comment.author, ink::kAccent, engine::UiFont::small);
  same_line_if_fits(width_of(when, engine::UiFont::small));
  put(when, ink::kSoft, engine::UiFont::small);
  if (!changes) draw_buttons(controls, comment);
  if (changes && change_ == Change::edits) return draw_edit(controls, run, out);
  put_wrapped(comment.text, ink::kText);
  if (changes) draw_delete(controls, run, out);
}

void CommentList::draw_buttons(Controls& controls, const lessons::CommentRow& comment) {
  {
    const engine::WithFont small(engine::UiFont::small);
    align_right(button_width("Edit") + button_width("Delete") + ImGui::GetStyle().ItemSpacing.x);
  }
  if (comment_button(controls, fmt::format("comment_edit: {}", comment.id), "Edit")) {
    change_ = Change::edits;
    changed_ = comment.id;
    std::snprintf(edited_.data(), edited_.size(), "%s", comment.text.c_str());
  }
  ImGui::SameLine();
  if (comment_button(controls, fmt::format("comment_delete: {}", comment.id), "Delete")) {
    change_ = Change::deletes;
    changed_ = comment.id;
  }
}

void CommentList::draw_edit(Controls& controls, std::int64_t run, PanelCommands& out) {
  ImGui::InputTextMultiline("##comment_text", edited_.data(), edited_.size(),
                            {ImGui::GetContentRegionAvail().x, kEditLines * ImGui::GetTextLineHeightWithSpacing()});
  controls.mark("comment_text");
  ImGui::BeginDisabled(!is_accepted(lessons::UserText::comment, "a comment", edited_.data()));
  if (comment_button(controls, "comment_save", "Save")) {
    out.push_back(EditComment{run, changed_, edited_.data()});
    change_ = Change::none;
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (comment_button(controls, "comment_cancel", "Cancel")) change_ = Change::none;
}

// Asks for confirmation before deleting a comment, because a deletion cannot be undone.
void CommentList::draw_delete(Controls& controls, std::int64_t run, PanelCommands& out) {
  const engine::WithFont small(engine::UiFont::small);
  if (controls.button("comment_delete_sure", "Delete permanently", {0.0f, 0.0f}, ink::kBadDeep)) {
    out.push_back(DeleteComment{run, changed_});
    change_ = Change::none;
  }
  ImGui::SameLine();
  if (controls.button("comment_cancel", "Keep")) change_ = Change::none;
}

void CommentList::draw_field(Controls& controls, std::int64_t run, PanelCommands& out) {
  const float em = engine::ui_em(), button = button_width("Add");
  ImGui::SetNextItemWidth(std::min(9.0f * em, ImGui::GetContentRegionAvail().x));
  ImGui::InputTextWithHint("##author", "your name", author_.data(), author_.size());
  controls.mark("comment_author");
  const bool named = is_accepted(lessons::UserText::name, "your name", author_.data());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool entered = ImGui::InputTextWithHint("##comment", "add a comment", text_.data(), text_.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  controls.mark("comment");
  ImGui::SameLine();
  const bool has_text = lessons::user_text_problem(lessons::UserText::comment, "a comment", text_.data()).empty();
  ImGui::BeginDisabled(!named || !has_text);
  const bool pressed = controls.button("comment_add", "Add");
  ImGui::EndDisabled();
  (void)is_accepted(lessons::UserText::comment, "a comment", text_.data());
  if (!(entered || pressed) || !named || !has_text) return;
  out.push_back(AddComment{run, author_.data(), text_.data()});
  text_.fill('\0');
}

}  // namespace gearshift::ui
