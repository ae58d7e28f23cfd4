#include "app/ui/panel/lesson_card.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/ui/panel/bottom_window.h"
#include "app/ui/panel/car_strip.h"
#include "app/ui/panel/key_legend.h"
#include "app/ui/panel/lesson_end.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/panel_keys.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

constexpr float kMaxCardWidth = 52.0f;  // [em]
// Usual and maximum height of the card as fractions of the available height [1], and its minimum height [em].
constexpr float kHeightFraction = 0.25f, kMaxHeightFraction = 0.62f, kMinHeight = 10.8f;
constexpr float kMaxLearnerFraction = 0.95f, kMinLearnerHeight = 6.0f;  // the same in the learner's view
constexpr double kFreshTime = 5.0;        // [s] how long a new feedback sentence is drawn large
constexpr std::size_t kOlderShown = 2;    // number of older feedback sentences shown
constexpr double kLittleTimeLeft = 20.0;  // [s] remaining time below which the time is shown as a warning
constexpr float kDefaultFoot = 5.0f;      // [em] assumed height of the controls until they are first drawn

bool begin_card(const ControlRect& room, ImVec2 size) {
  const float em = engine::ui_em();
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.9f * em, 0.5f * em});
  const bool open = begin_at_bottom("Lesson", room, ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  return open;
}

bool primary_button(Controls& controls, const char* name, const char* label, bool is_primary = true) {
  return controls.button(name, label, {0.0f, 0.0f}, is_primary ? ink::kPrimary : ink::kRaised);
}

// Draws a small button at the right end of the line, or on the next line if there is no room.
bool small_button(Controls& controls, const char* name, const char* label) {
  const engine::WithFont small(engine::UiFont::small);
  align_right(button_width(label));
  return controls.button(name, label);
}

// Draws a switch with two options. Returns true if it was clicked; a click selects the option that is off.
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

constexpr const char* kLeverPrompt =
    "Lever: click the cabin and use the mouse, click a gear below, or press the arrow keys. F1 shows all keys.";
constexpr const char* kFollowMe = "Follow me";
constexpr const char* kByYourself = "Do it yourself";
constexpr const char* kGuideMyHand = "Help me";

const char* describe_attempt(const lessons::CoachView& coach) {
  const bool prompted = coach.mode == lessons::LessonMode::follow_me;
  if (!coach.help_wanted)
    return prompted ? "Step-by-step prompts; the lever never guides your hand."
                    : "Only the goal is shown; the lever never guides your hand.";
  return prompted ? "Step-by-step prompts; on some attempts the lever guides your hand."
                  : "Only the goal is shown; on some attempts the lever guides your hand.";
}

// Draws a word on a coloured background, on the line of the previous item if it fits there.
const char* help_badge(const lessons::CoachView& coach) {
  if (coach.pedal_help == 0.0) return "lever guided, not graded";
  return coach.guidance > 0.0 ? "lever and pedals helped, not graded" : "pedals helped, not graded";
}

void draw_badge(const char* text, ImU32 colour) {
  const engine::WithFont small(engine::UiFont::small);
  const float em = engine::ui_em(), width = width_of(text) + 0.8f * em;
  same_line_if_fits(width);
  const ImVec2 at = ImGui::GetCursorScreenPos(), low(at.x, at.y + ImGui::GetStyle().FramePadding.y);
  ImGui::Dummy({width, ImGui::GetFontSize()});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({low.x, low.y - 0.1f * em}, {low.x + width, low.y + ImGui::GetFontSize() + 0.1f * em},
                     engine::with_alpha(colour, 0.2f), 0.3f * em);
  list.AddText({low.x + 0.4f * em, low.y}, colour, text);
}

// Draws a bar with one segment per step; the colour shows whether the step is done, current or still to come.
void draw_progress(std::size_t step, std::size_t steps) {
  if (steps == 0) return;
  const float em = engine::ui_em(), all = ImGui::GetContentRegionAvail().x, gap = 0.25f * em;
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

std::string format_step(const lessons::LessonView& view) {
  if (view.step >= view.steps) return "all steps done";
  return fmt::format("step {} of {}", view.step + 1, view.steps);
}

// "1:05 left"
std::string format_time_left(double seconds) {
  const int left = std::max(0, static_cast<int>(std::ceil(seconds)));
  return fmt::format("{}:{:02} left", left / 60, left % 60);
}

void draw_time_left(const lessons::CoachView& coach) {
  if (coach.time_limit <= 0.0 || coach.guidance > 0.0 || coach.pedal_help > 0.0) return;
  const double left = coach.time_limit - coach.result->duration;
  const std::string words = format_time_left(left);
  same_line_if_fits(width_of(words, engine::UiFont::small));
  put(words, left <= kLittleTimeLeft ? ink::kWarn : ink::kSoft, engine::UiFont::small);
}

// True if the live lever's forces are off; false during a replay, because input.now is then the recording's state.
bool are_forces_off(const PanelInput& input) {
  const haptics::GuardState guard = input.now.guard;
  return input.replay == nullptr && guard != haptics::GuardState::running && guard != haptics::GuardState::ramping;
}

const char* forces_off_text(const PanelInput& input) {
  const bool unplugged = input.stick && !input.stick->plugged_in;
  return unplugged ? "Forces are off. Plug in the stick, then press Enter to turn them on."
                   : "Forces are off. Press Enter to turn them on.";
}

void draw_title(const lessons::CoachView& coach) {
  ImGui::AlignTextToFramePadding();
  put(coach.title, ink::kAccent, engine::UiFont::title);
}

void draw_next(const lessons::CoachView& coach, bool has_next) {
  if (coach.next.empty()) return;
  put(has_next ? "Next" : "Repeat", ink::kSoft, engine::UiFont::small);
  const std::string_view title = lesson_title(coach, coach.next);
  same_line_if_fits(width_of(title, engine::UiFont::small));
  put(title, ink::kAccent, engine::UiFont::small);
  same_line_if_fits(width_of(coach.next_why, engine::UiFont::small));
  put_wrapped(coach.next_why, ink::kSoft);
}

}  // namespace

double LessonCard::draw(Controls& controls, const PanelInput& input, PanelView view, const ControlRect& room,
                        PanelCommands& out) {
  const lessons::CoachView& coach = input.coach;
  note_new_feedback(coach);
  const float em = engine::ui_em(), width = bottom_width(room, kMaxCardWidth);
  const auto height = static_cast<float>(room.max.y - room.min.y);
  const float usual =
      view == PanelView::learner ? kMinLearnerHeight * em : std::max(kHeightFraction * height, kMinHeight * em);
  const float most = view == PanelView::learner ? kMaxLearnerFraction * height : kMaxHeightFraction * height;
  const ImVec2 min_size(width, std::min(usual, most));
  follow(coach, view, min_size);
  if (coach.phase == lessons::LessonPhase::none || width < kMinBottomWidth * em) return room.max.y;
  const ImVec2 size(width, std::floor(std::max(min_size.y, std::min(needed_, most))));
  FrameContext now{controls, input, coach, view, are_forces_off(input), out};
  if (begin_card(room, size)) {
    if (coach.phase == lessons::LessonPhase::offered) draw_offered(now);
    if (coach.phase == lessons::LessonPhase::driving) draw_driving(now);
    if (coach.phase == lessons::LessonPhase::over) draw_over(now);
  }
  ImGui::End();
  return room.max.y - static_cast<double>(size.y + kBottomMargin * em);
}

// Resets the needed height if the lesson or the screen size changes, and in the learner's view with each step.
void LessonCard::follow(const lessons::CoachView& coach, PanelView view, ImVec2 size) {
  const std::size_t step = coach.now == nullptr ? 0 : coach.now->step;
  const std::size_t part = view == PanelView::learner ? 1 + static_cast<std::size_t>(coach.phase) + 4 * step : 0;
  if (coach.lesson == lesson_ && part == part_ && size.x == size_.x && size.y == size_.y) return;
  lesson_ = coach.lesson;
  part_ = part;
  size_ = size;
  needed_ = 0.0f;
}

// Notes when the newest feedback sentence arrived. Called even while the card is hidden, so that a sentence's age does
// not depend on when the card is shown.
void LessonCard::note_new_feedback(const lessons::CoachView& coach) {
  const std::size_t feedback = coach.phase == lessons::LessonPhase::driving ? coach.now->feedback.size() : 0;
  if (feedback > feedback_count_) feedback_time_ = ImGui::GetTime();
  feedback_count_ = feedback;
}

// Calls body() to draw the texts in an area that scrolls if necessary, and foot() to draw the controls below them.
// body() returns the height [px] of the texts that must be visible.
template <class Body, class Foot>
void LessonCard::draw_parts(lessons::LessonPhase phase, const Body& body, const Foot& foot) {
  std::optional<float>& foot_height = foot_[static_cast<std::size_t>(phase)];
  const bool is_known = foot_height.has_value();
  const float top = ImGui::GetCursorPosY(), reserved = foot_height.value_or(kDefaultFoot * engine::ui_em());
  const float height = std::max(engine::ui_em(), ImGui::GetContentRegionAvail().y - reserved);
  // No scroll bar while a lesson is driven, or before the height of the controls is known. Otherwise the bar would
  // appear for single frames and change the line breaks.
  const int bar = phase == lessons::LessonPhase::driving || !is_known ? ImGuiWindowFlags_NoScrollbar : 0;
  begin_child("texts", {0.0f, height}, bar);
  const float visible_height = body();
  ImGui::EndChild();
  const float begin = ImGui::GetCursorPosY();
  foot();
  foot_height = ImGui::GetCursorPosY() - begin;
  needed_ = std::max(needed_, top + visible_height + *foot_height + 0.5f * engine::ui_em());
}

// Draws the key legend and a prompt that says what moves the lever; while the panel is hidden, also the car's state.
void LessonCard::draw_controls_and_car(const FrameContext& now) {
  const bool is_learner = now.view == PanelView::learner, drives = now.coach.phase == lessons::LessonPhase::driving;
  if (is_learner && drives && !now.input.is_automatic_hand && !now.input.stick) {
    put(now.input.mouse_moves_lever ? mouse_prompt(true, true) : kLeverPrompt, ink::kSoft, engine::UiFont::small);
  } else if (!now.input.keys.empty() && !now.input.is_automatic_hand) {
    draw_keys(now.input.keys);
    const char* mouse = now.input.stick ? "Move the lever with the stick"
                                        : mouse_prompt(now.input.mouse_moves_lever, now.view != PanelView::hidden);
    ImGui::SameLine(0.0f, 0.8f * engine::ui_em());
    if (ImGui::GetContentRegionAvail().x < width_of(mouse, engine::UiFont::small)) ImGui::NewLine();
    put(mouse, now.input.mouse_moves_lever ? ink::kAccent : ink::kSoft, engine::UiFont::small);
  }
  if (now.view == PanelView::hidden) draw_car_strip(now.input.car, now.input.now.gear, now.coach.pedal_help);
}

void LessonCard::draw_offered(FrameContext& now) {
  const lessons::CoachView& coach = now.coach;
  PanelCommands& out = now.out;
  draw_title(coach);
  if (small_button(now.controls, "lesson_dismiss", "Not now")) out.push_back(DismissLesson{});
  const auto body = [&] {
    put_wrapped(coach.goal, ink::kText, engine::UiFont::prompt);
    if (!coach.fail_conditions.empty()) put_wrapped(coach.fail_conditions, ink::kSoft);
    put_wrapped(describe_attempt(coach), ink::kSoft);
    if (now.input.instructor_holds_pedals)
      put_wrapped("The instructor is holding the clutch and brake until you start. Press \"Not now\" to take over.",
                  ink::kWarn);
    return ImGui::GetCursorPosY();
  };
  const auto foot = [&] {
    if (primary_button(now.controls, "lesson_begin",
                       now.forces_off ? "Turn forces on and start (Enter)" : "Start (Enter)")) {
      if (now.forces_off) out.push_back(Arm{});
      out.push_back(BeginLesson{});
    }
    const bool by_yourself = coach.mode == lessons::LessonMode::by_yourself;
    same_line_if_fits(button_width(kFollowMe) + button_width(kByYourself));
    if (draw_switch(now.controls, "mode", kFollowMe, kByYourself, by_yourself))
      out.push_back(SetMode{by_yourself ? lessons::LessonMode::follow_me : lessons::LessonMode::by_yourself});
    same_line_if_fits(ImGui::GetFrameHeight() + button_width(kGuideMyHand));
    bool help = coach.help_wanted;
    if (ImGui::Checkbox(kGuideMyHand, &help)) out.push_back(SetHelp{help});
    now.controls.mark("help");
    draw_controls_and_car(now);
  };
  draw_parts(lessons::LessonPhase::offered, body, foot);
}

void LessonCard::draw_driving(FrameContext& now) {
  const lessons::CoachView& coach = now.coach;
  ImGui::AlignTextToFramePadding();
  put(coach.title, ink::kSoft, engine::UiFont::small);
  if (coach.now->steps > 0) {
    const std::string words = format_step(*coach.now);
    same_line_if_fits(width_of(words, engine::UiFont::small));
    put(words, ink::kAccent, engine::UiFont::small);
  }
  draw_time_left(coach);
  if (coach.guidance > 0.0 || coach.pedal_help > 0.0) draw_badge(help_badge(coach), ink::kAccent);
  if (coach.retention) draw_badge("test: no guidance", ink::kText);
  if (small_button(now.controls, "lesson_leave", "Leave")) now.out.push_back(LeaveLesson{});
  draw_progress(coach.now->step, coach.now->steps);
  draw_parts(
      lessons::LessonPhase::driving, [&] { return draw_prompts(now); }, [&] { draw_controls_and_car(now); });
}

// Returns the height that must be visible [px]: everything except the older sentences.
float LessonCard::draw_prompts(FrameContext& now) {
  const lessons::CoachView& coach = now.coach;
  put_wrapped(name_inputs(coach.now->prompt, now.input.keys), ink::kText, engine::UiFont::prompt);
  if (!now.input.reply.empty()) put_wrapped(now.input.reply, ink::kBad, engine::UiFont::title);
  if (now.forces_off) put_wrapped(forces_off_text(now.input), ink::kBad, engine::UiFont::title);
  if (now.input.car.stalled) draw_restart_prompt(now.input.keys);
  if (!coach.now->hint.empty())
    put_wrapped(name_inputs(coach.now->hint, now.input.keys), ink::kAccent, engine::UiFont::body);
  if (now.input.is_unpassable)
    put_wrapped("You can no longer pass this attempt. Keep practising, or press \"Leave\" and start again.",
                ink::kWarn);
  float visible_height = ImGui::GetCursorPosY();
  draw_feedback(coach.now->feedback, visible_height);
  return visible_height;
}

// Draws the newest sentence large for kFreshTime, then small like the older ones.
void LessonCard::draw_feedback(const std::vector<std::string>& feedback, float& visible_height) {
  const float line = engine::ui_font_size(engine::UiFont::title) + ImGui::GetStyle().ItemSpacing.y;
  const float begin = ImGui::GetCursorPosY();
  visible_height = begin + line;  // reserves one line
  if (feedback.empty()) return;
  const bool fresh = ImGui::GetTime() - feedback_time_ < kFreshTime;
  std::size_t left = kOlderShown + (fresh ? 1 : 0);
  for (std::size_t i = feedback.size(); i-- > 0 && left > 0; --left) {
    const bool newest = i + 1 == feedback.size();
    if (fresh && newest) {
      put_wrapped(feedback[i], ink::kWarn, engine::UiFont::title);
    } else {
      put_wrapped(feedback[i], engine::with_alpha(ink::kWarn, 0.7f), engine::UiFont::small);
    }
    if (newest) visible_height = std::max(visible_height, ImGui::GetCursorPosY());
  }
}

// Draws the result and the next lesson. Enter has the same effect as the coloured button; the button's label says so.
void LessonCard::draw_over(FrameContext& now) {
  const lessons::CoachView& coach = now.coach;
  PanelCommands& out = now.out;
  const bool has_next = !coach.next.empty() && coach.next != coach.lesson,
             can_continue = coach.result->passed && has_next;
  const auto foot = [&] {
    if (now.input.instructor_holds_pedals)
      put_wrapped("The instructor is holding the clutch and brake. Press \"Close\" to take over.", ink::kWarn);
    draw_next(coach, has_next);
    const char* again = can_continue     ? "Try again"
                        : now.forces_off ? "Turn forces on and retry (Enter)"
                                         : "Try again (Enter)";
    if (primary_button(now.controls, "lesson_again", again, !can_continue)) {
      if (now.forces_off) out.push_back(Arm{});
      out.push_back(BeginLesson{});
    }
    const char* next = can_continue ? "Next lesson (Enter)" : "Next lesson";
    if (has_next) {
      same_line_if_fits(button_width(next));
      if (primary_button(now.controls, "lesson_next", next, can_continue)) out.push_back(OfferLesson{coach.next});
    }
    if (small_button(now.controls, "lesson_dismiss", "Close")) out.push_back(DismissLesson{});
  };
  draw_parts(
      lessons::LessonPhase::over, [&] { return draw_lesson_end(coach); }, foot);
}

}  // namespace gearshift::ui
