#include "app/panel/lessons_view.h"

#include <imgui_internal.h>  // letters of UTF-8

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "app/history/typed_text.h"
#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr const char* kNobody = "nobody";

template <std::size_t n>
void fill(std::array<char, n>& field, const std::string& text) {
  std::snprintf(field.data(), n, "%s", text.c_str());
}

std::string trimmed(std::string text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
  return text;
}

bool is_known(const CoachView& coach, const std::string& name) {
  return std::find(coach.learners.begin(), coach.learners.end(), name) != coach.learners.end();
}

bool is_pressed(ImGuiKey_ key) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}

// The known ones behind an arrow, in a list as wide as the field before it [px].
void draw_known(Controls& controls, const CoachView& coach, float width, LessonRequests& out) {
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, 24.0f * ui_em()});
  const bool open = ImGui::BeginCombo("##known", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft);
  controls.mark("learner_known");
  if (!open) return;
  const auto entry = [&](const std::string& name, const char* label) {
    if (ImGui::Selectable(label, name == coach.learner) && name != coach.learner) out.learner = name;
    controls.mark("learner: " + name);
  };
  for (const std::string& name : coach.learners) entry(name, name.c_str());
  entry({}, kNobody);
  ImGui::EndCombo();
}

// No font that is shipped has every writing of the world.
bool has_every_sign(const std::string& name) {
  const ImFont* font = ImGui::GetFont();
  const char *at = name.data(), *end = at + name.size();
  while (at < end) {
    unsigned sign = 0;
    at += std::max(1, ImTextCharFromUtf8(&sign, at, end));
    if (sign > IM_UNICODE_CODEPOINT_MAX || font->FindGlyphNoFallback(static_cast<ImWchar>(sign)) == nullptr)
      return false;
  }
  return true;
}

// One line below the name, which keeps its place where there is nothing to say.
void draw_note(const CoachView& coach, const std::string& name, const std::string& problem, bool writes,
               bool by_itself) {
  if (!problem.empty()) return put_wrapped(problem, ink::kWarn);
  if (!has_every_sign(name))
    put_wrapped("The name is kept as it is; signs that no font here has are shown as ?", ink::kWarn);
  if (writes && name != coach.learner)
    return put_wrapped(
        name.empty() || is_known(coach, name) ? "Enter: this learner from now on." : "Enter: a new learner.",
        ink::kAccent);
  if (coach.forgotten)
    return put_wrapped(
        "Another program deleted this learner: nothing is remembered. To begin anew with the name: Enter in this "
        "field.",
        ink::kWarn);
  if (by_itself)
    return put_wrapped("The hand drives by itself: it is nobody's, and nothing is remembered of it.", ink::kSoft);
  if (!coach.remembers) return put_wrapped("The history is not open: nothing is remembered.", ink::kWarn);
  put_wrapped(coach.learner.empty() ? "Without a name nothing is remembered." : " ", ink::kSoft);
}

// With a bar at its left, which says that it is the one.
void draw_suggested(Controls& controls, const CoachView& coach, bool can_offer, LessonRequests& out) {
  if (coach.next.empty()) return;
  const float em = ui_em();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Indent(0.7f * em);
  ImGui::BeginGroup();
  put(coach.next_by_instructor ? "Next, by the instructor" : "Next, as suggested", ink::kSoft, UiFont::small);
  put_wrapped(lesson_title(coach, coach.next), ink::kAccent, UiFont::title);
  if (!coach.next_why.empty()) put_wrapped(coach.next_why, ink::kText);
  ImGui::BeginDisabled(!can_offer);
  if (controls.button("lesson_suggested", "Begin", {0.0f, 0.0f}, ink::kPrimary)) out.offer = coach.next;
  ImGui::EndDisabled();
  if (coach.next_by_instructor) {
    beside(button_width("As suggested"));
    if (controls.button("next_as_suggested", "As suggested")) out.next = std::string();
  }
  ImGui::EndGroup();
  ImGui::Unindent(0.7f * em);
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + 0.22f * em, ImGui::GetItemRectMax().y}, ink::kAccent, 1.0f);
}

// Passed: a hook on a disc. Tried: a ring. Else nothing.
void draw_standing(const LessonStanding& lesson) {
  const float em = ui_em(), radius = 0.42f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({2.0f * radius, ImGui::GetTextLineHeight()});
  const ImVec2 c(low.x + radius, low.y + 0.5f * ImGui::GetTextLineHeight());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (lesson.passed) {
    list.AddCircleFilled(c, radius, ink::kGood);
    const ImVec2 hook[] = {{c.x - 0.45f * radius, c.y},
                           {c.x - 0.1f * radius, c.y + 0.4f * radius},
                           {c.x + 0.5f * radius, c.y - 0.4f * radius}};
    list.AddPolyline(hook, 3, ink::kWell, 0, 0.12f * em);
  } else if (lesson.trials > 0) {
    list.AddCircle(c, radius, ink::kWarn, 0, 0.1f * em);
  }
}

// A dot that is filled for the next one; a press makes it that.
void draw_next_choice(Controls& controls, const CoachView& coach, const std::string& key, LessonRequests& out) {
  const float height = ImGui::GetTextLineHeight(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const std::string name = "next: " + key;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, 0.0f});
  if (controls.button(name.c_str(), "", {width, height}, with_alpha(ink::kRaised, 0.0f))) out.next = key;
  ImGui::PopStyleVar();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("make it the next one");
  const bool on = coach.next == key, hovered = ImGui::IsItemHovered();
  const ImVec2 c(low.x + 0.5f * width, low.y + 0.5f * height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddCircle(c, 0.34f * ui_em(), on || hovered ? ink::kAccent : ink::kLine, 0, 0.08f * ui_em());
  if (on) list.AddCircleFilled(c, 0.2f * ui_em(), ink::kAccent);
}

std::string grade_words(double grade) {
  return fmt::format("{:>4.1f}", grade);
}

// "7 trials, best 8.5; last 5.5, passed"
std::string standing_words(const LessonStanding& lesson) {
  std::string words = fmt::format("{} trial{}", lesson.trials, lesson.trials == 1 ? "" : "s");
  if (lesson.best) words += fmt::format(", best {:.1f}", *lesson.best);
  if (lesson.grade) words += fmt::format("; last {:.1f}", *lesson.grade);
  return words + (lesson.passed ? ", passed" : ", not passed yet");
}

void draw_lesson(Controls& controls, const CoachView& coach, const LessonStanding& lesson, bool can_offer,
                 LessonRequests& out) {
  ImGui::PushID(lesson.key.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_standing(lesson);
  ImGui::TableNextColumn();
  const bool is_here = coach.phase != LessonPhase::none && coach.lesson == lesson.key;
  const ImVec2 begin = ImGui::GetCursorPos();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(!can_offer);
  if (ImGui::Selectable("##lesson", is_here)) out.offer = lesson.key;
  controls.mark("lesson: " + lesson.key);
  if (lesson.trials > 0 && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", standing_words(lesson).c_str());
  ImGui::SetCursorPos(begin);
  controls.line(lesson.title, room, coach.next == lesson.key ? ink::kAccent : ink::kText);
  ImGui::EndDisabled();
  ImGui::TableNextColumn();
  if (lesson.passed && lesson.best) put(grade_words(*lesson.best), ink::kText);
  ImGui::TableNextColumn();
  if (lesson.grade) put(grade_words(*lesson.grade), ink::kSoft);
  ImGui::TableNextColumn();
  draw_next_choice(controls, coach, lesson.key, out);
  ImGui::PopID();
}

void draw_list(Controls& controls, const CoachView& coach, bool can_offer, LessonRequests& out) {
  const ImVec2 padding = ImGui::GetStyle().CellPadding;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.6f * padding.x, padding.y});
  const bool open = ImGui::BeginTable("lessons", 5, ImGuiTableFlags_SizingFixedFit);
  ImGui::PopStyleVar();
  if (!open) return;
  const float em = ui_em();
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 0.9f * em);
  ImGui::TableSetupColumn("lesson", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("best", ImGuiTableColumnFlags_WidthFixed, width_of("10.0", UiFont::body));
  ImGui::TableSetupColumn("last", ImGuiTableColumnFlags_WidthFixed, width_of("10.0", UiFont::body));
  ImGui::TableSetupColumn("next", ImGuiTableColumnFlags_WidthFixed, width_of("next", UiFont::small));
  ImGui::TableNextRow();
  for (const char* head : {"", "Lesson", "best", "last", "next"}) {
    ImGui::TableNextColumn();
    put(head, ink::kSoft, UiFont::small);
  }
  for (const LessonStanding& lesson : coach.lessons) draw_lesson(controls, coach, lesson, can_offer, out);
  ImGui::EndTable();
}

}  // namespace

void LessonsView::draw(Controls& controls, const CoachView& coach, bool by_itself, LessonRequests& out) {
  draw_learner(controls, coach, by_itself, out);
  ImGui::Spacing();
  // A lesson that is driven is not lost by a click on another one.
  const bool can_offer = coach.phase != LessonPhase::driving;
  draw_suggested(controls, coach, can_offer, out);
  ImGui::Spacing();
  draw_list(controls, coach, can_offer, out);
}

// A name that is written counts when Enter says so or the field is left; Escape takes it back.
void LessonsView::draw_learner(Controls& controls, const CoachView& coach, bool by_itself, LessonRequests& out) {
  if (coach.learner != shown_) fill(name_, shown_ = coach.learner);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Learner");
  ImGui::SameLine(4.6f * ui_em() - ImGui::GetStyle().WindowPadding.x);  // as the choices above
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(width - ImGui::GetFrameHeight());
  const bool entered =
      ImGui::InputTextWithHint("##learner", kNobody, name_.data(), name_.size(),
                               ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  controls.mark("learner");
  const bool writes = ImGui::IsItemActive(), left = ImGui::IsItemDeactivated();
  const bool given_up = left && is_pressed(ImGuiKey_Escape), leaves = left || (writes && is_pressed(ImGuiKey_Tab));
  const std::string name = trimmed(name_.data());
  const std::string problem =
      name.empty() ? std::string() : typed_text_problem(TypedText::name, "a learner's name", name);
  const bool is_another = name != coach.learner || (entered && coach.forgotten);
  if ((entered || leaves) && !given_up && problem.empty() && is_another) out.learner = name;
  if (left) fill(name_, given_up ? coach.learner : name);
  ImGui::SameLine(0.0f, 0.0f);
  draw_known(controls, coach, width, out);
  draw_note(coach, name, given_up ? std::string() : problem, writes, by_itself);
}

}  // namespace gearshift
