#include "app/ui/panel/lessons_view.h"

#include <imgui_internal.h>  // ImTextCharFromUtf8

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/lessons/history/user_text.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/panel_keys.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

constexpr const char* kNoLearner = "no learner";

template <std::size_t n>
void fill(std::array<char, n>& field, const std::string& text) {
  std::snprintf(field.data(), n, "%s", text.c_str());
}

// The known learner whom the name means; empty: none.
std::string known_name(const lessons::CoachView& coach, const std::string& name) {
  const std::optional<std::size_t> found = lessons::find_name(coach.learners, name);
  return found ? coach.learners[*found] : std::string();
}

// False if the current font lacks a character of the name.
bool has_all_glyphs(const std::string& name) {
  auto& glyphs = engine::ui_glyphs(ImGui::GetFont());
  const char *at = name.data(), *end = at + name.size();
  while (at < end) {
    unsigned code = 0;
    at += std::max(1, ImTextCharFromUtf8(&code, at, end));
    if (code > IM_UNICODE_CODEPOINT_MAX || glyphs.FindGlyphNoFallback(static_cast<ImWchar>(code)) == nullptr)
      return false;
  }
  return true;
}

// Draws a note below the name field. Without a note the line is blank, so that the layout does not move.
void draw_note(const lessons::CoachView& coach, const std::string& name, const std::string& problem, bool is_typing,
               bool is_automatic_hand) {
  if (!problem.empty()) return put_wrapped(problem, ink::kWarn);
  if (!has_all_glyphs(name))
    put_wrapped("The name is saved as typed. Characters that cannot be displayed are shown as \"?\".", ink::kWarn);
  if (is_typing && name != coach.learner)
    return put_wrapped(name.empty() || !known_name(coach, name).empty() ? "Press Enter to switch learners."
                                                                        : "Press Enter to add this learner.",
                       ink::kAccent);
  if (coach.learner_deleted)
    return put_wrapped(
        "Another program deleted this learner, so nothing is being saved. Press Enter in this field to add the name "
        "again.",
        ink::kWarn);
  if (is_automatic_hand) return put_wrapped("The simulated driver is driving, so nothing is saved.", ink::kSoft);
  if (!coach.is_saving) return put_wrapped("Your history could not be opened, so nothing is being saved.", ink::kWarn);
  put_wrapped(coach.learner.empty() ? "Enter a name to save your progress." : " ", ink::kSoft);
}

// Draws the next lesson, marked by a bar on its left.
void draw_suggested(Controls& controls, const lessons::CoachView& coach, bool can_offer, PanelCommands& out) {
  if (coach.next.empty()) return;
  const float em = engine::ui_em();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Indent(0.7f * em);
  ImGui::BeginGroup();
  put(coach.next_by_instructor ? "Next (instructor's choice)" : "Suggested next", ink::kSoft, engine::UiFont::small);
  put_wrapped(lesson_title(coach, coach.next), ink::kAccent, engine::UiFont::title);
  if (!coach.next_why.empty()) put_wrapped(coach.next_why, ink::kText);
  ImGui::BeginDisabled(!can_offer);
  if (controls.button("lesson_suggested", "Start", {0.0f, 0.0f}, ink::kPrimary)) out.push_back(OfferLesson{coach.next});
  ImGui::EndDisabled();
  if (coach.next_by_instructor) {
    same_line_if_fits(button_width("Use suggestion"));
    if (controls.button("next_as_suggested", "Use suggestion")) out.push_back(ChooseNextLesson{});
  }
  ImGui::EndGroup();
  ImGui::Unindent(0.7f * em);
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + 0.22f * em, ImGui::GetItemRectMax().y}, ink::kAccent, 1.0f);
}

// Draws a tick on a disc if the lesson is mastered, a half-filled ring if it was passed once, a ring if it was only tried,
// and nothing if it was never tried.
void draw_standing(const lessons::LessonStanding& lesson) {
  const float em = engine::ui_em(), radius = 0.42f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({2.0f * radius, ImGui::GetTextLineHeight()});
  const ImVec2 c(low.x + radius, low.y + 0.5f * ImGui::GetTextLineHeight());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (lesson.mastery == lessons::Mastery::mastered) {
    list.AddCircleFilled(c, radius, ink::kGood);
    const ImVec2 tick[] = {{c.x - 0.45f * radius, c.y},
                           {c.x - 0.1f * radius, c.y + 0.4f * radius},
                           {c.x + 0.5f * radius, c.y - 0.4f * radius}};
    list.AddPolyline(tick, 3, ink::kWell, 0, 0.12f * em);
  } else if (lesson.mastery == lessons::Mastery::passed_once) {
    constexpr float kQuarter = 1.5707963f;  // [rad]
    list.AddCircle(c, radius, ink::kGood, 0, 0.1f * em);
    list.PathArcTo(c, radius, kQuarter, 3.0f * kQuarter);
    list.PathFillConvex(ink::kGood);
  } else if (lesson.tries > 0) {
    list.AddCircle(c, radius, ink::kWarn, 0, 0.1f * em);
  }
}

// Draws a ring, with a dot in it for the next lesson; a click makes this lesson the next one.
void draw_next_choice(Controls& controls, const lessons::CoachView& coach, const std::string& key, PanelCommands& out) {
  const float height = ImGui::GetTextLineHeight(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, 0.0f});
  if (controls.button(controls.join("next", key), "", {width, height}, engine::with_alpha(ink::kRaised, 0.0f)))
    out.push_back(ChooseNextLesson{key});
  ImGui::PopStyleVar();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Set as next lesson");
  const bool on = coach.next == key, hovered = ImGui::IsItemHovered();
  const ImVec2 c(low.x + 0.5f * width, low.y + 0.5f * height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddCircle(c, 0.34f * engine::ui_em(), on || hovered ? ink::kAccent : ink::kLine, 0, 0.08f * engine::ui_em());
  if (on) list.AddCircleFilled(c, 0.2f * engine::ui_em(), ink::kAccent);
}

std::string format_grade(double grade) {
  return fmt::format("{:>4.1f}", grade);
}

// "7 attempts, 2 not graded; best 8.5, last 5.5. Not passed yet."
std::string format_standing(const lessons::LessonStanding& lesson) {
  std::string words = fmt::format("{} attempt{}", lesson.tries, lesson.tries == 1 ? "" : "s");
  if (lesson.tries > lesson.trials) words += fmt::format(", {} not graded", lesson.tries - lesson.trials);
  if (lesson.best) words += fmt::format("; best {:.1f}", *lesson.best);
  if (lesson.grade) words += fmt::format(", last {:.1f}", *lesson.grade);
  return fmt::format("{}. {}", words, lessons::mastery_sentence(lesson.mastery));
}

void draw_lesson(Controls& controls, const lessons::CoachView& coach, const lessons::LessonStanding& lesson,
                 bool can_offer, PanelCommands& out) {
  ImGui::PushID(lesson.key.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_standing(lesson);
  ImGui::TableNextColumn();
  const bool is_here = coach.phase != lessons::LessonPhase::none && coach.lesson == lesson.key;
  const ImVec2 begin = ImGui::GetCursorPos();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(!can_offer);
  if (ImGui::Selectable("##lesson", is_here)) out.push_back(OfferLesson{lesson.key});
  controls.mark(controls.join("lesson", lesson.key));
  if (lesson.tries > 0 && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", format_standing(lesson).c_str());
  ImGui::SetCursorPos(begin);
  controls.line(lesson.title, room, coach.next == lesson.key ? ink::kAccent : ink::kText);
  ImGui::EndDisabled();
  ImGui::TableNextColumn();
  if (lesson.passed && lesson.best) put(format_grade(*lesson.best), ink::kText);
  ImGui::TableNextColumn();
  if (lesson.grade) put(format_grade(*lesson.grade), ink::kSoft);
  ImGui::TableNextColumn();
  draw_next_choice(controls, coach, lesson.key, out);
  ImGui::PopID();
}

void draw_list(Controls& controls, const lessons::CoachView& coach, bool can_offer, PanelCommands& out) {
  const ImVec2 padding = ImGui::GetStyle().CellPadding;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.6f * padding.x, padding.y});
  const bool open = ImGui::BeginTable("lessons", 5, ImGuiTableFlags_SizingFixedFit);
  ImGui::PopStyleVar();
  if (!open) return;
  const float em = engine::ui_em();
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 0.9f * em);
  ImGui::TableSetupColumn("lesson", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("best", ImGuiTableColumnFlags_WidthFixed, width_of("10.0", engine::UiFont::body));
  ImGui::TableSetupColumn("last", ImGuiTableColumnFlags_WidthFixed, width_of("10.0", engine::UiFont::body));
  ImGui::TableSetupColumn("next", ImGuiTableColumnFlags_WidthFixed, width_of("next", engine::UiFont::small));
  ImGui::TableNextRow();
  for (const char* head : {"", "Lesson", "Best", "Last", "Next"}) {
    ImGui::TableNextColumn();
    put(head, ink::kSoft, engine::UiFont::small);
  }
  for (const lessons::LessonStanding& lesson : coach.lessons) draw_lesson(controls, coach, lesson, can_offer, out);
  ImGui::EndTable();
}

}  // namespace

void LessonsView::draw(Controls& controls, const lessons::CoachView& coach, bool is_automatic_hand,
                       PanelCommands& out) {
  draw_learner(controls, coach, is_automatic_hand, out);
  ImGui::Spacing();
  // While a lesson is driven, disables the other lessons: a click on one of them must not discard the current lesson.
  const bool can_offer = coach.phase != lessons::LessonPhase::driving;
  draw_suggested(controls, coach, can_offer, out);
  ImGui::Spacing();
  draw_list(controls, coach, can_offer, out);
}

// Draws the known learners as a drop-down list, with an entry that renames the current one. `width` [px]: width of the
// opened list.
void LessonsView::draw_known(Controls& controls, const lessons::CoachView& coach, float width, PanelCommands& out) {
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, 24.0f * engine::ui_em()});
  const bool open = ImGui::BeginCombo("##known", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft);
  controls.mark("learner_known");
  if (!open) return;
  const auto entry = [&](const std::string& name, const char* label) {
    if (ImGui::Selectable(label, name == coach.learner) && name != coach.learner) out.push_back(ChooseLearner{name});
    controls.mark(controls.join("learner", name));
  };
  for (const std::string& name : coach.learners) entry(name, name.c_str());
  entry({}, kNoLearner);
  if (!coach.learner.empty() && !coach.learner_deleted) {
    ImGui::Separator();
    if (ImGui::Selectable(fmt::format("Rename {}", coach.learner).c_str())) is_renaming_ = takes_keyboard_ = true;
    controls.mark("learner_rename");
  }
  ImGui::EndCombo();
}

// Asks whether the user is the learner who has this name already.
void LessonsView::draw_question(Controls& controls, PanelCommands& out) {
  put_wrapped(fmt::format("There is a learner named {} already. Is this you?", asked_), ink::kAccent);
  const bool is_same = controls.button("learner_same", "Yes", {0.0f, 0.0f}, ink::kPrimary);
  ImGui::SameLine();
  const bool is_other = controls.button("learner_other", "No");
  if (is_same) out.push_back(ChooseLearner{asked_});
  if (is_other) refused_ = asked_, takes_keyboard_ = true;
  if (is_same || is_other) asked_.clear();
}

// Applies a valid name that was typed.
void LessonsView::apply_name(const lessons::CoachView& coach, const std::string& name, PanelCommands& out) {
  const std::string known = known_name(coach, name);
  const bool is_others = !known.empty() && known != coach.learner;
  if (is_renaming_ && is_others)
    refused_ = known, takes_keyboard_ = true;
  else if (is_renaming_)
    out.push_back(RenameLearner{name}), is_renaming_ = false;
  else if (is_others)
    asked_ = known;
  else if (known.empty() || coach.learner_deleted)
    out.push_back(ChooseLearner{name});
}

// Draws the field for the learner's name. Pressing Enter or leaving the field applies a typed name; Escape discards it.
void LessonsView::draw_learner(Controls& controls, const lessons::CoachView& coach, bool is_automatic_hand,
                               PanelCommands& out) {
  if (coach.learner != shown_) {
    fill(name_, shown_ = coach.learner);
    asked_.clear(), refused_.clear();
    is_renaming_ = false;
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", is_renaming_ ? "Rename" : "Learner");
  ImGui::SameLine(4.6f * engine::ui_em() - ImGui::GetStyle().WindowPadding.x);  // aligned with the lists above
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(width - ImGui::GetFrameHeight());
  if (std::exchange(takes_keyboard_, false)) give_keyboard_to_next();
  const bool entered =
      ImGui::InputTextWithHint("##learner", kNoLearner, name_.data(), name_.size(),
                               ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  controls.mark("learner");
  const bool is_typing = ImGui::IsItemActive(), left = ImGui::IsItemDeactivated();
  const bool is_emptied = is_renaming_ && name_[0] == '\0';
  const bool is_cancelled = left && (is_emptied || ImGui::IsKeyPressed(ImGuiKey_Escape, false)),
             leaves = left || (is_typing && ImGui::IsKeyPressed(ImGuiKey_Tab, false));
  const std::string name = lessons::stored_name(name_.data());
  const std::string problem =
      name.empty() ? std::string() : lessons::user_text_problem(lessons::UserText::name, "a learner's name", name);
  if (is_typing || is_cancelled) asked_.clear();
  const bool is_another = name != coach.learner || (entered && coach.learner_deleted);
  if ((entered || leaves) && !is_cancelled && problem.empty() && is_another) apply_name(coach, name, out);
  if (left && !takes_keyboard_) is_renaming_ = false;
  if (left) fill(name_, is_cancelled || known_name(coach, name) == coach.learner ? coach.learner : name);
  ImGui::SameLine(0.0f, 0.0f);
  draw_known(controls, coach, width, out);
  if (!asked_.empty()) return draw_question(controls, out);
  if (!refused_.empty() && refused_ != known_name(coach, name)) refused_.clear();
  if (!refused_.empty())
    return put_wrapped(fmt::format("{} is another learner: add a surname, for example.", refused_), ink::kWarn);
  if (is_renaming_)
    return put_wrapped(problem.empty() ? "Type the new name and press Enter." : problem,
                       problem.empty() ? ink::kAccent : ink::kWarn);
  draw_note(coach, name, is_cancelled ? std::string() : problem, is_typing, is_automatic_hand);
}

}  // namespace gearshift::ui
