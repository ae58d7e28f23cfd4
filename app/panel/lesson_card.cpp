#include "app/panel/lesson_card.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr float kMostWidth = 42.0f, kLeastWidth = 10.0f, kMargin = 0.8f;  // [em]
constexpr double kFresh = 5.0;                                            // [s] that a new sentence is large
constexpr std::size_t kOlder = 2;                                         // sentences that are kept in sight after it
constexpr float kOpaque = 0.76f;

bool begin_card(const ControlRect& room, float width) {
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;
  const float em = ui_em();
  const auto height = static_cast<float>(room.max.y - room.min.y);
  const ImVec2 top(0.5f * static_cast<float>(room.min.x + room.max.x),
                   static_cast<float>(room.min.y) + 0.5f * kMargin * em);
  ImGui::SetNextWindowPos(top, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, std::max(em, height - kMargin * em)});
  ImGui::SetNextWindowBgAlpha(kOpaque);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * em);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.9f * em, 0.6f * em});
  const bool open = ImGui::Begin("Lesson", nullptr, kFlags);
  ImGui::PopStyleVar(2);
  return open;
}

bool primary(Controls& controls, const char* name, const char* label, bool is_primary = true) {
  return controls.button(name, label, {0.0f, 0.0f}, is_primary ? ink::kPrimary : ink::kRaised);
}

// Small, at the right end of the line; below where the line is full.
bool quiet_button(Controls& controls, const char* name, const char* label) {
  const WithFont small(UiFont::small);
  at_right(button_width(label));
  return controls.button(name, label);
}

// Two that exclude each other: a press anywhere on them takes the other one.
bool draw_switch(Controls& controls, const char* name, const char* first, const char* second, bool is_second) {
  const ImVec2 padding = ImGui::GetStyle().FramePadding, low = ImGui::GetCursorScreenPos();
  const float left = button_width(first), right = button_width(second), height = ImGui::GetFrameHeight();
  const bool pressed = controls.button(name, "", {left + right, height}, ink::kWell);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto part = [&](float x, float width, const char* label, bool on) {
    if (on)
      list.AddRectFilled({x, low.y}, {x + width, low.y + height}, ink::kAccentDeep, ImGui::GetStyle().FrameRounding);
    list.AddText({x + padding.x, low.y + padding.y}, on ? ink::kText : ink::kSoft, label);
  };
  part(low.x, left, first, !is_second);
  part(low.x + left, right, second, is_second);
  return pressed;
}

constexpr const char* kFollow = "Follow me";
constexpr const char* kAlone = "Do it yourself";

const char* trial_words(const CoachView& coach) {
  const bool prompted = coach.mode == LessonMode::follow_me;
  if (!coach.help_wanted)
    return prompted ? "Every step is prompted. The lever leads in no trial."
                    : "Only the goal is told. The lever leads in no trial.";
  return prompted ? "Every step is prompted. The lever leads in some of the trials."
                  : "Only the goal is told. The lever leads in some of the trials.";
}

// A word in a frame of its colour, on a line of buttons.
void draw_mark(const char* text, ImU32 colour) {
  const WithFont small(UiFont::small);
  const float em = ui_em(), width = width_of(text) + 0.8f * em;
  beside(width);
  const ImVec2 at = ImGui::GetCursorScreenPos(), low(at.x, at.y + ImGui::GetStyle().FramePadding.y);
  ImGui::Dummy({width, ImGui::GetFontSize()});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({low.x, low.y - 0.1f * em}, {low.x + width, low.y + ImGui::GetFontSize() + 0.1f * em},
                     with_alpha(colour, 0.2f), 0.3f * em);
  list.AddText({low.x + 0.4f * em, low.y}, colour, text);
}

// A bar of as many parts as there are steps: done, this one, to come.
void draw_progress(std::size_t step, std::size_t steps) {
  if (steps == 0) return;
  const float em = ui_em(), all = ImGui::GetContentRegionAvail().x, gap = 0.25f * em;
  const float part = (all + gap) / static_cast<float>(steps), height = 0.3f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < steps; ++i) {
    const float x = low.x + part * static_cast<float>(i);
    const ImU32 colour = i < step ? ink::kGood : i == step ? ink::kAccent : ink::kRaised;
    list.AddRectFilled({x, low.y}, {x + std::max(1.0f, part - gap), low.y + height}, colour, 0.5f * height);
  }
  ImGui::Dummy({all, height});
}

std::string step_words(const LessonView& view) {
  if (view.step >= view.steps) return "all steps done";
  return fmt::format("step {} of {}", view.step + 1, view.steps);
}

const char* outcome_words(const LessonResult& result) {
  if (shows_grade(result)) return result.passed ? "Passed" : "Not passed";
  if (result.end == LessonEnd::left) return "Left";
  return result.end == LessonEnd::done ? "Done" : "Not done";
}

// The grade, or that there is none; as wide as the grade is in any case.
void draw_grade(const LessonResult& result) {
  const float em = ui_em(), begin = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  if (shows_grade(result)) {
    put(verdict_words(result), verdict_colour(result), UiFont::digits);
    ImGui::SameLine(0.0f, 0.3f * em);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui_font(UiFont::digits)->FontSize - 1.5f * em);
    put("of 10", ink::kSoft, UiFont::small);
  } else {
    ImGui::Dummy({0.0f, 0.3f * em});
    put("not", ink::kSoft, UiFont::prompt);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.35f * em);
    put("graded", ink::kSoft, UiFont::prompt);
  }
  ImGui::EndGroup();
  const float wanted = begin + std::max(9.2f * em, ImGui::GetItemRectSize().x + em);
  ImGui::SameLine(wanted);
  if (ImGui::GetContentRegionAvail().x < 9.0f * em) ImGui::NewLine();
}

void draw_outcome(const CoachView& coach) {
  const LessonResult& result = coach.result;
  ImGui::BeginGroup();
  put_wrapped(coach.title, ink::kSoft, UiFont::small);
  put(outcome_words(result), shows_grade(result) ? verdict_colour(result) : ink::kText, UiFont::prompt);
  if (!result.why.empty()) put_wrapped(result.why, ink::kText, UiFont::body);
  ImGui::EndGroup();
}

// What cost points; where nothing did because there is no grade, what would have.
bool is_told(const LessonResult& result, std::size_t fault) {
  return points_of_fault(result, fault) > 0.0 ||
         (!shows_grade(result) && result.faults[fault].severity != Severity::note);
}

void draw_fault(const LessonResult& result, std::size_t index) {
  const DriveFault& fault = result.faults[index];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  put(fmt::format("{:.1f} s", fault.time - result.begin), ink::kSoft, UiFont::small);
  ImGui::TableNextColumn();
  put_wrapped(fault_sentence(fault), ink::kText, UiFont::small);
  ImGui::TableNextColumn();
  const double points = points_of_fault(result, index);
  if (points > 0.0 && shows_grade(result))
    put(fmt::format("-{:.1f}", points), severity_colour(fault.severity), UiFont::small);
}

}  // namespace

void LessonCard::draw(Controls& controls, const CoachView& coach, const ControlRect& room, LessonRequests& out) {
  listen(coach);
  const float em = ui_em(), all = static_cast<float>(room.max.x - room.min.x);
  const float width = std::min(kMostWidth * em, all - 2.0f * kMargin * em);
  if (coach.phase == LessonPhase::none || width < kLeastWidth * em) return;
  most_list_ = std::max(3.0f * em, 0.24f * static_cast<float>(room.max.y - room.min.y));
  if (begin_card(room, width)) {
    if (coach.phase == LessonPhase::offered) draw_offered(controls, coach, out);
    if (coach.phase == LessonPhase::driving) draw_driving(controls, coach, out);
    if (coach.phase == LessonPhase::over) draw_over(controls, coach, out);
  }
  ImGui::End();
}

// Also while it is not seen: what is fresh is so by the clock.
void LessonCard::listen(const CoachView& coach) {
  const std::size_t said = coach.phase == LessonPhase::driving ? coach.now.said.size() : 0;
  if (said > said_) said_at_ = ImGui::GetTime();
  said_ = said;
}

void LessonCard::draw_offered(Controls& controls, const CoachView& coach, LessonRequests& out) {
  put_wrapped(coach.title, ink::kAccent, UiFont::title);
  put_wrapped(coach.goal, ink::kText, UiFont::prompt);
  ImGui::Spacing();
  const bool alone = coach.mode == LessonMode::by_yourself;
  out.begin = primary(controls, "lesson_begin", "Enter begins") || out.begin;
  beside(button_width(kFollow) + button_width(kAlone));
  if (draw_switch(controls, "mode", kFollow, kAlone, alone))
    out.mode = alone ? LessonMode::follow_me : LessonMode::by_yourself;
  beside(ImGui::GetFrameHeight() + button_width("Help"));
  bool help = coach.help_wanted;
  if (ImGui::Checkbox("Help", &help)) out.help = help;
  controls.mark("help");
  if (quiet_button(controls, "lesson_put_away", "Not now")) out.put_away = true;
  put_wrapped(trial_words(coach), ink::kSoft);
}

void LessonCard::draw_driving(Controls& controls, const CoachView& coach, LessonRequests& out) {
  ImGui::AlignTextToFramePadding();
  put(coach.title, ink::kSoft, UiFont::small);
  if (coach.now.steps > 0) {
    const std::string words = step_words(coach.now);
    beside(width_of(words, UiFont::small));
    put(words, ink::kAccent, UiFont::small);
  }
  if (coach.guidance > 0.0) draw_mark("guided, not graded", ink::kAccent);
  if (coach.retention) draw_mark("test: no help", ink::kText);
  if (quiet_button(controls, "lesson_leave", "Leave")) out.leave = true;
  draw_progress(coach.now.step, coach.now.steps);
  ImGui::Spacing();
  put_wrapped(coach.now.prompt, ink::kText, UiFont::prompt);
  if (!coach.now.hint.empty()) put_wrapped(coach.now.hint, ink::kAccent, UiFont::body);
  draw_said(coach.now.said);
}

// The newest large as long as it is new, then small like those before it.
void LessonCard::draw_said(const std::vector<std::string>& said) {
  if (said.empty()) return;
  const bool fresh = ImGui::GetTime() - said_at_ < kFresh;
  std::size_t left = kOlder + (fresh ? 1 : 0);
  for (std::size_t i = said.size(); i-- > 0 && left > 0; --left) {
    if (fresh && i + 1 == said.size()) {
      put_wrapped(said[i], ink::kWarn, UiFont::title);
    } else {
      put_wrapped(said[i], with_alpha(ink::kWarn, 0.7f), UiFont::small);
    }
  }
}

void LessonCard::draw_over(Controls& controls, const CoachView& coach, LessonRequests& out) {
  draw_grade(coach.result);
  draw_outcome(coach);
  draw_faults(coach.result);
  ImGui::Separator();
  const bool has_next = !coach.next.empty() && coach.next != coach.lesson, passed = coach.result.passed;
  if (!coach.next.empty()) {
    put(has_next ? "Next" : "Once more", ink::kSoft, UiFont::small);
    const std::string title = lesson_title(coach, coach.next);
    beside(width_of(title, UiFont::title));
    put(title, ink::kAccent, UiFont::title);
    put_wrapped(coach.next_why, ink::kSoft);
    ImGui::Spacing();
  }
  if (primary(controls, "lesson_again", "Again", !passed || !has_next)) out.begin = true;
  if (has_next) {
    beside(button_width("Next lesson"));
    if (primary(controls, "lesson_next", "Next lesson", passed)) out.offer = coach.next;
  }
  if (quiet_button(controls, "lesson_put_away", "Close")) out.put_away = true;
}

// In the order of the drive.
void LessonCard::draw_faults(const LessonResult& result) {
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < result.faults.size(); ++i)
    if (is_told(result, i)) told.push_back(i);
  if (told.empty()) return;
  ImGui::Spacing();
  const float height = faults_height_ > 0.0f ? std::min(faults_height_, most_list_) : most_list_;
  ImGui::BeginChild("faults", {0.0f, height}, false, ImGuiWindowFlags_NavFlattened);
  if (ImGui::BeginTable("fault", 3, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, 3.4f * ui_em());
    ImGui::TableSetupColumn("says", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("points", ImGuiTableColumnFlags_WidthFixed, 2.2f * ui_em());
    for (const std::size_t fault : told) draw_fault(result, fault);
    ImGui::EndTable();
  }
  faults_height_ = ImGui::GetCursorPosY();
  ImGui::EndChild();
}

}  // namespace gearshift
