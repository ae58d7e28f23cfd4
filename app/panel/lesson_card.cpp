#include "app/panel/lesson_card.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/panel/car_strip.h"
#include "app/panel/foot_window.h"
#include "app/panel/key_legend.h"
#include "app/panel/lesson_end.h"
#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr float kMostWidth = 52.0f;                                        // [em]
constexpr float kShare = 0.25f, kMostShare = 0.62f, kLeastHeight = 10.8f;  // [1] of the room; [em]
constexpr double kFresh = 5.0;                                             // [s] that a new sentence is large
constexpr std::size_t kOlder = 2;                                          // sentences that are kept in sight after it
constexpr double kTimeIsShort = 20.0;                                      // [s] left
constexpr float kUsualFoot = 5.0f;                                         // [em] until it has been drawn once

bool begin_card(const ControlRect& room, ImVec2 size) {
  const float em = ui_em();
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.9f * em, 0.5f * em});
  const bool open = begin_at_foot("Lesson", room, ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
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

// "1:05 left"
std::string left_words(double seconds) {
  const int left = std::max(0, static_cast<int>(std::ceil(seconds)));
  return fmt::format("{}:{:02} left", left / 60, left % 60);
}

void draw_time_left(const CoachView& coach) {
  if (coach.time_limit <= 0.0) return;
  const double left = coach.time_limit - coach.result.duration;
  const std::string words = left_words(left);
  beside(width_of(words, UiFont::small));
  put(words, left <= kTimeIsShort ? ink::kWarn : ink::kSoft, UiFont::small);
}

// What is looked at again says nothing of the forces now.
bool are_forces_off(const PanelInput& input) {
  const GuardState guard = input.now.guard;
  return input.replay == nullptr && guard != GuardState::running && guard != GuardState::ramping;
}

const char* motors_off_words(const PanelInput& input) {
  const bool unplugged = input.stick && !input.stick->plugged_in;
  return unplugged ? "Motors off. Plug the stick in, then Enter gives them back."
                   : "Motors off. Enter gives them back.";
}

void draw_title(const CoachView& coach) {
  ImGui::AlignTextToFramePadding();
  put(coach.title, ink::kAccent, UiFont::title);
}

void draw_next(const CoachView& coach, bool has_next) {
  if (coach.next.empty()) return;
  put(has_next ? "Next" : "Once more", ink::kSoft, UiFont::small);
  const std::string title = lesson_title(coach, coach.next);
  beside(width_of(title, UiFont::small));
  put(title, ink::kAccent, UiFont::small);
  beside(width_of(coach.next_why, UiFont::small));
  put_wrapped(coach.next_why, ink::kSoft);
}

}  // namespace

double LessonCard::draw(Controls& controls, const PanelInput& input, bool panel_shown, const ControlRect& room,
                        PanelRequests& out) {
  const CoachView& coach = input.coach;
  listen(coach);
  const float em = ui_em(), width = foot_width(room, kMostWidth);
  const auto height = static_cast<float>(room.max.y - room.min.y);
  const ImVec2 least(width, std::min(std::max(kShare * height, kLeastHeight * em), kMostShare * height));
  follow(coach, least);
  if (coach.phase == LessonPhase::none || width < kLeastFootWidth * em) return room.max.y;
  const ImVec2 size(width, std::floor(std::max(least.y, std::min(needed_, kMostShare * height))));
  Now now{controls, input, coach, panel_shown, are_forces_off(input), out};
  if (begin_card(room, size)) {
    if (coach.phase == LessonPhase::offered) draw_offered(now);
    if (coach.phase == LessonPhase::driving) draw_driving(now);
    if (coach.phase == LessonPhase::over) draw_over(now);
  }
  ImGui::End();
  return room.max.y - static_cast<double>(size.y + kFootMargin * em);
}

// Another lesson, another screen: its height is found anew.
void LessonCard::follow(const CoachView& coach, ImVec2 size) {
  if (coach.lesson == lesson_ && size.x == size_.x && size.y == size_.y) return;
  lesson_ = coach.lesson;
  size_ = size;
  needed_ = 0.0f;
}

// Also while it is not seen: what is fresh is so by the clock.
void LessonCard::listen(const CoachView& coach) {
  const std::size_t said = coach.phase == LessonPhase::driving ? coach.now.said.size() : 0;
  if (said > said_) said_at_ = ImGui::GetTime();
  said_ = said;
}

// The texts, which scroll where they must, and what stands below them at the card's foot. body: returns how much of it
// must be seen [px].
template <class Body, class Foot>
void LessonCard::draw_parts(LessonPhase phase, const Body& body, const Foot& foot) {
  float& foot_height = foot_[static_cast<std::size_t>(phase)];
  const bool is_known = foot_height > 0.0f;
  const float top = ImGui::GetCursorPosY(), kept = is_known ? foot_height : kUsualFoot * ui_em();
  const float height = std::max(ui_em(), ImGui::GetContentRegionAvail().y - kept);
  // No bar beside a prompt, nor before the foot is known: it would come and go, and break lines anew.
  const int bar = phase == LessonPhase::driving || !is_known ? ImGuiWindowFlags_NoScrollbar : 0;
  ImGui::BeginChild("texts", {0.0f, height}, false, ImGuiWindowFlags_NavFlattened | bar);
  const float must = body();
  ImGui::EndChild();
  const float begin = ImGui::GetCursorPosY();
  foot();
  foot_height = ImGui::GetCursorPosY() - begin;
  needed_ = std::max(needed_, top + must + foot_height + 0.5f * ui_em());
}

// What a hand needs to know besides: keys, who leads the lever, and the car where no bar tells of it.
void LessonCard::draw_helps(const Now& now) {
  if (!now.input.keys.empty() && !now.input.by_itself) {
    draw_keys(now.input.keys);
    const char* mouse =
        now.input.stick ? "The stick is the lever" : mouse_words(now.input.mouse_leads, now.panel_shown);
    ImGui::SameLine(0.0f, 0.8f * ui_em());
    if (ImGui::GetContentRegionAvail().x < width_of(mouse, UiFont::small)) ImGui::NewLine();
    put(mouse, now.input.mouse_leads ? ink::kAccent : ink::kSoft, UiFont::small);
  }
  if (!now.panel_shown) draw_car_strip(now.input.car, now.input.now.gear);
}

void LessonCard::draw_offered(Now& now) {
  const CoachView& coach = now.coach;
  LessonRequests& out = now.out.lesson;
  draw_title(coach);
  if (quiet_button(now.controls, "lesson_put_away", "Not now")) out.put_away = true;
  const auto body = [&] {
    put_wrapped(coach.goal, ink::kText, UiFont::prompt);
    if (!now.input.lesson_catches.empty()) put_wrapped(now.input.lesson_catches, ink::kSoft);
    put_wrapped(trial_words(coach), ink::kSoft);
    if (now.input.teacher_holds)
      put_wrapped("The teacher holds clutch and brake until it begins; Not now gives them back.", ink::kWarn);
    return ImGui::GetCursorPosY();
  };
  const auto foot = [&] {
    if (primary(now.controls, "lesson_begin", now.forces_off ? "Enter: motors on, and begin" : "Enter begins")) {
      out.begin = true;
      now.out.arm = now.out.arm || now.forces_off;
    }
    const bool alone = coach.mode == LessonMode::by_yourself;
    beside(button_width(kFollow) + button_width(kAlone));
    if (draw_switch(now.controls, "mode", kFollow, kAlone, alone))
      out.mode = alone ? LessonMode::follow_me : LessonMode::by_yourself;
    beside(ImGui::GetFrameHeight() + button_width("Help"));
    bool help = coach.help_wanted;
    if (ImGui::Checkbox("Help", &help)) out.help = help;
    now.controls.mark("help");
    draw_helps(now);
  };
  draw_parts(LessonPhase::offered, body, foot);
}

void LessonCard::draw_driving(Now& now) {
  const CoachView& coach = now.coach;
  ImGui::AlignTextToFramePadding();
  put(coach.title, ink::kSoft, UiFont::small);
  if (coach.now.steps > 0) {
    const std::string words = step_words(coach.now);
    beside(width_of(words, UiFont::small));
    put(words, ink::kAccent, UiFont::small);
  }
  draw_time_left(coach);
  if (coach.guidance > 0.0) draw_mark("guided, not graded", ink::kAccent);
  if (coach.retention) draw_mark("test: no help", ink::kText);
  if (quiet_button(now.controls, "lesson_leave", "Leave")) now.out.lesson.leave = true;
  draw_progress(coach.now.step, coach.now.steps);
  draw_parts(
      LessonPhase::driving, [&] { return draw_prompts(now); }, [&] { draw_helps(now); });
}

// Returns the height that must be seen [px]: all but the older sentences.
float LessonCard::draw_prompts(Now& now) {
  const CoachView& coach = now.coach;
  put_wrapped(coach.now.prompt, ink::kText, UiFont::prompt);
  if (now.forces_off) put_wrapped(motors_off_words(now.input), ink::kBad, UiFont::title);
  if (now.input.car.stalled) draw_restart_words(now.input.keys);
  if (!coach.now.hint.empty()) put_wrapped(coach.now.hint, ink::kAccent, UiFont::body);
  if (now.input.trial_lost)
    put_wrapped("This try is not passed any more: go on to learn, or leave it and begin again.", ink::kWarn);
  float must = ImGui::GetCursorPosY();
  draw_said(coach.now.said, must);
  return must;
}

// The newest large as long as it is new, then small like those before it.
void LessonCard::draw_said(const std::vector<std::string>& said, float& must) {
  const float line = ui_font(UiFont::title)->FontSize + ImGui::GetStyle().ItemSpacing.y;
  const float begin = ImGui::GetCursorPosY();
  must = begin + line;  // a place for one is kept
  if (said.empty()) return;
  const bool fresh = ImGui::GetTime() - said_at_ < kFresh;
  std::size_t left = kOlder + (fresh ? 1 : 0);
  for (std::size_t i = said.size(); i-- > 0 && left > 0; --left) {
    const bool newest = i + 1 == said.size();
    if (fresh && newest) {
      put_wrapped(said[i], ink::kWarn, UiFont::title);
    } else {
      put_wrapped(said[i], with_alpha(ink::kWarn, 0.7f), UiFont::small);
    }
    if (newest) must = std::max(must, ImGui::GetCursorPosY());
  }
}

// Enter does what the coloured button does, and that button says so.
void LessonCard::draw_over(Now& now) {
  const CoachView& coach = now.coach;
  LessonRequests& out = now.out.lesson;
  const bool has_next = !coach.next.empty() && coach.next != coach.lesson, goes_on = coach.result.passed && has_next;
  const auto foot = [&] {
    if (now.input.teacher_holds)
      put_wrapped("The teacher holds clutch and brake until the next lesson; Close gives them back.", ink::kWarn);
    draw_next(coach, has_next);
    const char* again = goes_on ? "Again" : now.forces_off ? "Enter: motors on, and again" : "Enter: again";
    if (primary(now.controls, "lesson_again", again, !goes_on)) {
      out.begin = true;
      now.out.arm = now.out.arm || now.forces_off;
    }
    const char* next = goes_on ? "Enter: next lesson" : "Next lesson";
    if (has_next) {
      beside(button_width(next));
      if (primary(now.controls, "lesson_next", next, goes_on)) out.offer = coach.next;
    }
    if (quiet_button(now.controls, "lesson_put_away", "Close")) out.put_away = true;
  };
  draw_parts(
      LessonPhase::over, [&] { return draw_lesson_end(coach); }, foot);
}

}  // namespace gearshift
