#include "app/panel/control_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/panel/car_strip.h"
#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"
#include "app/panel/value_text.h"

namespace gearshift {
namespace {

// [em] wide
constexpr float kCar = 14.6f, kLamps = 6.2f, kState = 7.0f, kArm = 5.5f, kRecording = 7.4f, kStop = 9.0f;
constexpr float kEstimatedLamps = 8.2f, kLeastMessage = 9.0f;
constexpr int kLampColumns = 3;

// The bar from left to right; each part takes its width and leaves the cursor at its right.
class Parts {
 public:
  Parts() : low_(ImGui::GetCursorScreenPos()), height_(ImGui::GetContentRegionAvail().y) {}

  ImVec2 low() const { return low_; }
  float height() const { return height_; }
  void next(float width) { go_to(low_.x + width + ui_em()); }
  void go_to(float x) {
    low_.x = x;
    ImGui::SetCursorScreenPos(low_);
  }

 private:
  ImVec2 low_;
  float height_;
};

// zone [1]: of the pedal, where it takes hold; none where it is empty.
void pedal(const char* name, double pressed, ImVec2 low, ImVec2 size, ImU32 colour, double zone_from = 0.0,
           double zone_to = 0.0) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui_font(UiFont::small);
  const float foot = low.y + size.y - font->FontSize;
  const float top = foot - (foot - low.y) * static_cast<float>(std::clamp(pressed, 0.0, 1.0));
  list.AddRectFilled(low, {low.x + size.x, foot}, ink::kWell, 2.0f);
  list.AddRectFilled({low.x, top}, {low.x + size.x, foot}, colour, 2.0f);
  const auto height_of = [&](double at) { return foot - (foot - low.y) * static_cast<float>(at); };
  if (zone_to > zone_from)
    list.AddRectFilled({low.x, height_of(zone_to)}, {low.x + size.x, height_of(zone_from)}, ink::kBiteZone);
  const float width = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, name).x;
  list.AddText(font, font->FontSize, {low.x + 0.5f * (size.x - width), foot}, ink::kSoft, name);
}

// An arrow beside the gear: the next one up would do with less fuel, or the engine labours and wants the one below.
void draw_advice(ImVec2 at, int advice) {
  if (advice == 0) return;
  const float em = ui_em(), up = advice > 0 ? -1.0f : 1.0f;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = advice > 0 ? ink::kGood : ink::kWarn;
  const ImVec2 tip(at.x, at.y + up * 0.75f * em), neck(at.x, at.y + up * 0.1f * em);
  list.AddTriangleFilled(tip, {neck.x - 0.5f * em, neck.y}, {neck.x + 0.5f * em, neck.y}, colour);
  list.AddRectFilled({at.x - 0.18f * em, std::min(neck.y, at.y - up * 0.6f * em)},
                     {at.x + 0.18f * em, std::max(neck.y, at.y - up * 0.6f * em)}, colour);
}

void draw_car(const Parts& parts, const PanelInput& input) {
  const float em = ui_em(), gear_width = 2.9f * em, text_width = 6.4f * em, pedal_width = 1.4f * em;
  const VehicleState& car = input.car;
  ImFont* digits = ui_font(UiFont::digits);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = parts.low();
  const char* gear = gear_name(input.now.gear);
  const float width = digits->CalcTextSizeA(digits->FontSize, 1e9f, 0.0f, gear).x;
  list.AddText(digits, digits->FontSize,
               {low.x + 0.5f * (gear_width - width), low.y + 0.5f * (parts.height() - digits->FontSize)},
               car.grinding ? ink::kBad : ink::kText, gear);
  draw_advice({low.x + gear_width + 0.5f * em, low.y + 0.5f * parts.height()}, car.shift_advice);
  const float line = ImGui::GetTextLineHeightWithSpacing(), at = low.x + gear_width + 1.3f * em;
  const float top = low.y + 0.5f * (parts.height() - 2.0f * line) + 0.1f * em;
  list.AddText({at, top}, car.stalled || car.over_revved ? ink::kBad : ink::kText,
               (car.stalled ? std::string("stalled") : rpm_words(car.engine_speed)).c_str());
  if (car.stalled)
    list.AddRectFilled({at - 0.3f * em, top}, {at + 4.6f * em, top + ImGui::GetTextLineHeight()},
                       with_alpha(ink::kBad, 0.25f), 3.0f);
  list.AddText({at, top + line}, ink::kText, value_text(kKmhPerMps * car.road_speed, "km/h", 0).c_str());
  float x = low.x + gear_width + text_width;
  const ImVec2 size(pedal_width, parts.height());
  pedal("C", car.clutch, {x, low.y}, size, ink::kAccent, car.clutch_closed, car.clutch_bite);
  pedal("B", car.brake, {x += pedal_width + 0.4f * em, low.y}, size, ink::kBad);
  pedal("T", car.throttle, {x + pedal_width + 0.4f * em, low.y}, size, ink::kGood);
}

void lamp(ImVec2 at, const char* text, bool on, ImU32 colour) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui_font(UiFont::small);
  const float em = ui_em();
  const ImVec2 middle(at.x + 0.5f * em, at.y + 0.5f * font->FontSize);
  if (on) list.AddCircleFilled(middle, 0.55f * em, with_alpha(colour, 0.3f));
  list.AddCircleFilled(middle, 0.32f * em, on ? colour : ink::kRaised);
  list.AddText(font, font->FontSize, {at.x + 1.2f * em, at.y}, on ? colour : with_alpha(ink::kSoft, 0.75f), text);
}

struct Lamp {
  std::string name;
  bool on;
  ImU32 colour;
  const char* means;
};

// Of the road, where it is none; else nothing.
Lamp slope_lamp(const VehicleState& car) {
  const double slope = slope_percent(car);
  if (slope == 0.0) return {{}, false, 0, ""};
  return {fmt::format("Slope {:+.0f} %", slope), true, ink::kText, "How steep the road is: uphill is more than zero."};
}

// Where no sensor feels the hand, its push is only estimated, and so is the warning.
Lamp over_push_lamp(const HapticSnapshot& now) {
  const bool on = (now.flags & kFlagOverPush) != 0, estimated = (now.flags & kFlagPushEstimated) != 0;
  return {estimated && on ? "Push, estimated" : "Over-push", on, ink::kBad,
          estimated ? "The hand pushes harder than the device can hold: estimated, for the device does not feel it."
                    : "The hand pushes harder than the device can hold."};
}

// [em] of the first column: "Push, estimated" is longer than any other.
float first_lamps(const PanelInput& input) {
  return (input.now.flags & kFlagPushEstimated) != 0 ? kEstimatedLamps : kLamps;
}

// In columns of three, the more important ones first.
void draw_lamps(const Parts& parts, int columns, const PanelInput& input) {
  const HapticSnapshot& now = input.now;
  const bool softened = now.wall_stiffness > 0.0 && now.wall_stiffness < 0.999 * input.admitted.tuning.wall_stiffness;
  const VehicleState& car = input.car;
  const Lamp lamps[kLampColumns][3] = {
      {over_push_lamp(now),
       {"Saturated", (now.flags & kFlagSaturated) != 0, ink::kWarn, "More force is wanted than the device can give."},
       {"Ghost hand", (now.flags & kFlagGhost) != 0, ink::kWarn,
        "The drawn lever stays in the gate; the hand has pushed the real one through a wall."}},
      {{"Grinding", car.grinding, ink::kBad, "Teeth on teeth: the clutch is not down."},
       {"Over-rev", car.over_revved, ink::kBad, "The engine is above its red line: off the throttle."},
       {"Softened", softened, ink::kWarn, "The walls are softer than wanted, for the lever chattered on one."}},
      {{"Hand brake", car.hand_brake > kHandBrakeOn, ink::kBad, "It is on."},
       {"Ignition", car.ignition, ink::kGood, "It is on."},
       slope_lamp(car)}};
  const float em = ui_em(), line = parts.height() / 3.0f;
  const float above = 0.5f * (line - ui_font(UiFont::small)->FontSize);
  float x = parts.low().x;
  for (int column = 0; column < columns; ++column) {
    const float width = (column == 0 ? first_lamps(input) : kLamps) * em;
    for (int row = 0; row < 3; ++row) {
      const Lamp& l = lamps[column][row];
      if (l.name.empty()) continue;
      const float y = parts.low().y + static_cast<float>(row) * line;
      lamp({x, y + above}, l.name.c_str(), l.on, l.colour);
      if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect({x, y}, {x + width, y + line}))
        ImGui::SetTooltip("%s", l.means);
    }
    x += width;
  }
}

// As much of it as has room [px].
std::string loop_line(const PanelInput& input, float width) {
  const LoopHealth& health = input.health;
  std::string rate = fmt::format("{:.0f} Hz", health.rate);
  const std::string late = fmt::format("p99 late {:.0f} µs", 1e6 * health.late_p99),
                    missed = fmt::format("{} missed", health.skipped),
                    frame = input.frame_ms > 0.0 ? fmt::format(" · {:.0f} ms a frame", input.frame_ms) : std::string();
  const std::string lines[] = {fmt::format("{} · {} · {}{}", rate, late, missed, frame),
                               fmt::format("{} · {}{}", rate, missed, frame), fmt::format("{} · {}", rate, missed)};
  for (const std::string& line : lines)
    if (width_of(line) <= width) return line;
  return rate;
}

// The message takes what is left; where it is longer than two lines of that, it is there to be hovered. True where all
// of it is seen.
bool draw_message(Controls& controls, const Parts& parts, float width, const PanelInput& input) {
  const WithFont small(UiFont::small);
  const ImVec2 low = parts.low();
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 room(width, parts.height() - line - 2.0f);
  const std::string message = with_short_paths(input.message, width);
  ImGui::PushClipRect(low, {low.x + room.x, low.y + room.y}, true);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  ImGui::TextUnformatted(message.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopClipRect();
  const bool is_cut = ImGui::GetItemRectSize().y > room.y;
  if ((is_cut || message != input.message) && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", input.message.c_str());
  ImGui::SetCursorScreenPos({low.x, low.y + parts.height() - line});
  controls.line(loop_line(input, width), width, ink::kSoft);
  return !is_cut;
}

ImU32 state_colour(GuardState state) {
  switch (state) {
    case GuardState::running:
      return ink::kGood;
    case GuardState::armed:
    case GuardState::ramping:
      return ink::kAccent;
    case GuardState::damped:
      return ink::kWarn;
    case GuardState::released:
      return ink::kBad;
    case GuardState::idle:
      return ink::kSoft;
  }
  return ink::kSoft;
}

void draw_state(const Parts& parts, float width, const HapticSnapshot& now) {
  const ImU32 colour = state_colour(now.guard);
  const bool fell =
      (now.guard == GuardState::damped || now.guard == GuardState::released) && now.fault != GuardFault::none;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = parts.low(), high(low.x + width, low.y + parts.height());
  list.AddRectFilled(low, high, with_alpha(colour, 0.16f), 4.0f);
  list.AddRect(low, high, with_alpha(colour, 0.7f), 4.0f);
  const auto centred = [&](UiFont which, const char* text, float y, ImU32 shade) {
    ImFont* font = ui_font(which);
    const float text_width = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, text).x;
    list.AddText(font, font->FontSize, {low.x + 0.5f * (width - text_width), y}, shade, text);
  };
  const float title = ui_font(UiFont::title)->FontSize, small = ui_font(UiFont::small)->FontSize;
  const float top = low.y + 0.5f * (parts.height() - title - (fell ? small : 0.0f));
  centred(UiFont::title, guard_state_name(now.guard), top, colour);
  if (fell) centred(UiFont::small, guard_fault_name(now.fault), top + title, ink::kText);
}

void draw_arm(Controls& controls, const Parts& parts, float width, const PanelInput& input, PanelRequests& out) {
  const GuardState state = input.now.guard;
  const bool off = state == GuardState::idle || state == GuardState::damped || state == GuardState::released;
  const ImVec2 size(width, parts.height());
  if (off) {
    ImGui::BeginDisabled(input.stick && !input.stick->plugged_in);
    out.arm = controls.button("arm", "Arm", size, ink::kAccentDeep);
    ImGui::EndDisabled();
  } else {
    out.disarm = controls.button("disarm", "Release", size);
  }
}

// What a lesson records of itself ends with it and not before.
void draw_recording(Controls& controls, const Parts& parts, float width, const PanelInput& input, PanelRequests& out) {
  const float gap = 0.25f * ui_em();
  const ImVec2 size(width, 0.5f * (parts.height() - gap));
  const bool of_lesson = input.recording && input.coach.phase == LessonPhase::driving;
  if (of_lesson) {
    const WithFont small(UiFont::small);
    ImGui::BeginDisabled();
    controls.button("record", "lesson recorded", size);
    ImGui::EndDisabled();
  } else {
    out.record = input.recording ? controls.button("record", "End recording", size, ink::kBadDeep)
                                 : controls.button("record", "Record", size);
  }
  ImGui::SetCursorScreenPos({parts.low().x, parts.low().y + size.y + gap});
  out.replay = controls.button("replay", "Replay", size);
}

// When it goes down, wherever the mouse goes from there.
void draw_stop(Controls& controls, const Parts& parts, float width, PanelRequests& out) {
  const WithFont large(UiFont::digits);
  controls.button("stop", "STOP", {width, parts.height()}, ink::kBadDeep);
  out.stop = ImGui::IsItemActivated();
}

// What there is room for: the less important parts give way.
struct Shown {
  bool state, arm, car, recording;
  int lamps;      // columns
  float message;  // [em] wide; 0: none
};

Shown what_fits(float room, float first_lamps) {
  const auto fits = [&room](float width) {
    const bool does = room >= width + 1.0f;
    if (does) room -= width + 1.0f;
    return does;
  };
  Shown shown{};
  room -= kStop;
  shown.arm = fits(kArm);
  shown.state = fits(kState);
  shown.car = fits(kCar);
  shown.recording = fits(kRecording);
  if (fits(first_lamps)) shown.lamps = 1;
  while (shown.lamps > 0 && shown.lamps < kLampColumns && fits(kLamps - 1.0f)) ++shown.lamps;
  if (room >= kLeastMessage + 1.0f) shown.message = room - 1.0f;
  return shown;
}

}  // namespace

bool draw_control_bar(Controls& controls, const PanelInput& input, PanelRequests& out) {
  const float em = ui_em(), all = ImGui::GetContentRegionAvail().x;
  const float stop = std::min(kStop * em, all), right_group = ImGui::GetCursorScreenPos().x + all;
  const Shown shown = what_fits(all / em, first_lamps(input));
  Parts parts;
  if (shown.car) {
    draw_car(parts, input);
    parts.next(kCar * em);
  }
  if (shown.lamps > 0) {
    draw_lamps(parts, shown.lamps, input);
    parts.next((first_lamps(input) + static_cast<float>(shown.lamps - 1) * kLamps) * em);
  }
  const bool told = shown.message > 0.0f && draw_message(controls, parts, shown.message * em, input);
  const float group = (shown.state ? kState + 1.0f : 0.0f) + (shown.arm ? kArm + 1.0f : 0.0f) +
                      (shown.recording ? kRecording + 1.0f : 0.0f);
  parts.go_to(right_group - stop - group * em);
  if (shown.state) {
    draw_state(parts, kState * em, input.now);
    parts.next(kState * em);
  }
  if (shown.arm) {
    draw_arm(controls, parts, kArm * em, input, out);
    parts.next(kArm * em);
  }
  if (shown.recording) {
    draw_recording(controls, parts, kRecording * em, input, out);
    parts.next(kRecording * em);
  }
  draw_stop(controls, parts, stop, out);
  return told;
}

}  // namespace gearshift
