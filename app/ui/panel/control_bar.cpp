#include "app/ui/panel/control_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/ui/panel/car_strip.h"
#include "app/ui/panel/format_value.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/files/parameter.h"

namespace gearshift::ui {
namespace {

// [em] Widths of the bar's parts.
constexpr float kCar = 14.6f, kLamps = 6.2f, kState = 7.0f, kArm = 5.5f, kRecording = 7.4f, kStop = 9.0f;
constexpr float kEstimatedLamps = 8.2f, kMinMessageWidth = 9.0f;
constexpr int kLampColumns = 3;

// Lays out the bar from left to right; each part advances the cursor by its width.
class BarCursor {
 public:
  BarCursor() : low_(ImGui::GetCursorScreenPos()), height_(ImGui::GetContentRegionAvail().y) {}

  ImVec2 low() const { return low_; }
  float height() const { return height_; }
  void next(float width) { go_to(low_.x + width + engine::ui_em()); }
  void go_to(float x) {
    low_.x = x;
    ImGui::SetCursorScreenPos(low_);
  }

 private:
  ImVec2 low_;
  float height_;
};

// `zone_from`, `zone_to` [1]: the bite zone in fractions of the pedal travel; not drawn if empty (`zone_from` >=
// `zone_to`). `mark` [1]: strength of its outline.
void pedal(const char* name, double pressed, ImVec2 low, ImVec2 size, ImU32 colour, double zone_from = 0.0,
           double zone_to = 0.0, double mark = 0.0) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float foot = low.y + size.y - engine::ui_font_size(font);
  const float top = foot - (foot - low.y) * static_cast<float>(std::clamp(pressed, 0.0, 1.0));
  list.AddRectFilled(low, {low.x + size.x, foot}, ink::kWell, 2.0f);
  list.AddRectFilled({low.x, top}, {low.x + size.x, foot}, colour, 2.0f);
  const auto height_of = [&](double at) { return foot - (foot - low.y) * static_cast<float>(at); };
  if (zone_to > zone_from)
    list.AddRectFilled({low.x, height_of(zone_to)}, {low.x + size.x, height_of(zone_from)}, ink::kBiteZone);
  if (zone_to > zone_from && mark > 0.0)
    list.AddRect({low.x - 2.0f, height_of(zone_to)}, {low.x + size.x + 2.0f, height_of(zone_from)},
                 engine::with_alpha(ink::kBiteMark, static_cast<float>(mark)), 0.0f, 0, 2.0f);
  const float width = font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, name).x;
  list.AddText(font, engine::ui_font_size(font), {low.x + 0.5f * (size.x - width), foot}, ink::kSoft, name);
}

// Draws an arrow to the right of the gear: up if the next higher gear would save fuel, down if the engine labours.
void draw_shift_arrow(ImVec2 at, int advice) {
  if (advice == 0) return;
  const float em = engine::ui_em(), up = advice > 0 ? -1.0f : 1.0f;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = advice > 0 ? ink::kGood : ink::kWarn;
  const ImVec2 tip(at.x, at.y + up * 0.75f * em), neck(at.x, at.y + up * 0.1f * em);
  list.AddTriangleFilled(tip, {neck.x - 0.5f * em, neck.y}, {neck.x + 0.5f * em, neck.y}, colour);
  list.AddRectFilled({at.x - 0.18f * em, std::min(neck.y, at.y - up * 0.6f * em)},
                     {at.x + 0.18f * em, std::max(neck.y, at.y - up * 0.6f * em)}, colour);
}

void draw_car(const BarCursor& parts, const PanelInput& input) {
  const float em = engine::ui_em(), gear_width = 2.9f * em, text_width = 6.4f * em, pedal_width = 1.4f * em;
  const vehicle::VehicleState& car = input.car;
  ImFont* digits = engine::ui_font(engine::UiFont::digits);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = parts.low();
  const char* gear = haptics::gear_label(input.gate, input.now.gear);
  const float width = digits->CalcTextSizeA(engine::ui_font_size(digits), 1e9f, 0.0f, gear).x;
  list.AddText(digits, engine::ui_font_size(digits),
               {low.x + 0.5f * (gear_width - width), low.y + 0.5f * (parts.height() - engine::ui_font_size(digits))},
               car.grinding ? ink::kBad : ink::kText, gear);
  draw_shift_arrow({low.x + gear_width + 0.5f * em, low.y + 0.5f * parts.height()}, car.shift_advice);
  const float line = ImGui::GetTextLineHeightWithSpacing(), at = low.x + gear_width + 1.3f * em;
  const float top = low.y + 0.5f * (parts.height() - 2.0f * line) + 0.1f * em;
  list.AddText({at, top}, car.stalled || car.over_revved ? ink::kBad : ink::kText,
               (car.stalled ? std::string("stalled") : format_rpm(car.engine_speed)).c_str());
  if (car.stalled)
    list.AddRectFilled({at - 0.3f * em, top}, {at + 4.6f * em, top + ImGui::GetTextLineHeight()},
                       engine::with_alpha(ink::kBad, 0.25f), 3.0f);
  list.AddText({at, top + line}, ink::kText, format_speed(car).c_str());
  float x = low.x + gear_width + text_width;
  const ImVec2 size(pedal_width, parts.height());
  pedal("C", car.pedals.clutch, {x, low.y}, size, ink::kAccent, car.clutch_closed, car.clutch_bite,
        input.coach.pedal_help);
  pedal("B", car.pedals.brake, {x += pedal_width + 0.4f * em, low.y}, size, ink::kBad);
  pedal("T", car.pedals.throttle, {x + pedal_width + 0.4f * em, low.y}, size, ink::kGood);
}

void lamp(ImVec2 at, const char* text, bool on, ImU32 colour) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float em = engine::ui_em();
  const ImVec2 middle(at.x + 0.5f * em, at.y + 0.5f * engine::ui_font_size(font));
  if (on) list.AddCircleFilled(middle, 0.55f * em, engine::with_alpha(colour, 0.3f));
  list.AddCircleFilled(middle, 0.32f * em, on ? colour : ink::kRaised);
  list.AddText(font, engine::ui_font_size(font), {at.x + 1.2f * em, at.y},
               on ? colour : engine::with_alpha(ink::kSoft, 0.75f), text);
}

struct Lamp {
  std::string name;
  bool on;
  ImU32 colour;
  const char* tooltip;
};

// The slope lamp. Its name is empty on a level road, where the lamp is not drawn.
Lamp slope_lamp(const vehicle::VehicleState& car) {
  const double slope = slope_percent(car);
  if (slope == 0.0) return {{}, false, 0, ""};
  return {fmt::format("Slope {:+.0f} %", slope), true, ink::kText, "Road slope; positive values are uphill."};
}

// The lamp that lights if the user pushes harder than the device can resist. Its text says if this is only an estimate,
// because the device has no force sensor.
Lamp over_push_lamp(const haptics::HapticSnapshot& now) {
  const bool on = (now.flags & haptics::kFlagOverPush) != 0, estimated = (now.flags & haptics::kFlagPushEstimated) != 0;
  return {estimated && on ? "Push (estimated)" : "Over-push", on, ink::kBad,
          estimated
              ? "You seem to be pushing harder than the device can resist. This is an estimate: the device has no "
                "force sensor."
              : "You are pushing harder than the device can resist."};
}

// Width [em] of the first column of lamps. The column is wider if its longest name, "Push (estimated)", may appear.
float first_lamp_width(const PanelInput& input) {
  return (input.now.flags & haptics::kFlagPushEstimated) != 0 ? kEstimatedLamps : kLamps;
}

// Draws the warning lamps in columns of three, most important first.
void draw_lamps(const BarCursor& parts, int columns, const PanelInput& input) {
  const haptics::HapticSnapshot& now = input.now;
  const bool softened = now.wall_stiffness > 0.0 && now.wall_stiffness < 0.999 * input.admitted.tuning.wall_stiffness;
  const vehicle::VehicleState& car = input.car;
  const Lamp lamps[kLampColumns][3] = {
      {over_push_lamp(now),
       {"Saturated", (now.flags & haptics::kFlagSaturated) != 0, ink::kWarn,
        "More force was requested than the device can deliver."},
       {"Past wall", (now.flags & haptics::kFlagGhost) != 0, ink::kWarn,
        "Your hand has pushed the real lever through a wall; the drawn lever stays in the gate."}},
      {{"Grinding", car.grinding, ink::kBad, "Lit while the gears grind: press the clutch."},
       {"Over-rev", car.over_revved, ink::kBad, "Lit while the engine is above its red line: ease off the throttle."},
       {"Softened", softened, ink::kWarn, "The walls were softened because the lever chattered against one."}},
      {{"Handbrake", car.pedals.hand_brake > kHandBrakeOn, ink::kBad, "Lit while the handbrake is on."},
       {"Ignition", car.ignition, ink::kGood, "Lit while the ignition is on."},
       slope_lamp(car)}};
  const float em = engine::ui_em(), line = parts.height() / 3.0f;
  const float above = 0.5f * (line - engine::ui_font_size(engine::UiFont::small));
  float x = parts.low().x;
  for (int column = 0; column < columns; ++column) {
    const float width = (column == 0 ? first_lamp_width(input) : kLamps) * em;
    for (int row = 0; row < 3; ++row) {
      const Lamp& l = lamps[column][row];
      if (l.name.empty()) continue;
      const float y = parts.low().y + static_cast<float>(row) * line;
      lamp({x, y + above}, l.name.c_str(), l.on, l.colour);
      if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect({x, y}, {x + width, y + line}))
        tooltip_above({x, ImGui::GetWindowPos().y}, l.tooltip);
    }
    x += width;
  }
}

// Returns loop rate, lateness and missed cycles in one line. The less important figures are left out if the line would
// be wider than `width` [px].
std::string loop_line(const PanelInput& input, float width) {
  const runtime::LoopHealth& health = input.health;
  std::string rate = fmt::format("{:.0f} Hz", health.rate);
  const std::string late = fmt::format("lateness p99 {:.0f} µs", 1e6 * health.late_p99),
                    missed = fmt::format("{} missed", health.skipped),
                    frame = input.frame_ms > 0.0 ? fmt::format(" · {:.0f} ms/frame", input.frame_ms) : std::string();
  const std::string lines[] = {fmt::format("{} · {} · {}{}", rate, late, missed, frame),
                               fmt::format("{} · {}{}", rate, missed, frame), fmt::format("{} · {}", rate, missed)};
  for (const std::string& line : lines)
    if (width_of(line) <= width) return line;
  return rate;
}

// Draws the message, and below it one line of loop figures. If the message or a path in the message is cut off, a
// tooltip shows the whole text. Returns true if no line of the message is cut off.
bool draw_message(Controls& controls, const BarCursor& parts, float width, const PanelInput& input) {
  const engine::WithFont small(engine::UiFont::small);
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
  if ((is_cut || message != input.message) && ImGui::IsItemHovered())
    tooltip_above({low.x, ImGui::GetWindowPos().y}, input.message);
  ImGui::SetCursorScreenPos({low.x, low.y + parts.height() - line});
  controls.line(loop_line(input, width), width, ink::kSoft);
  return !is_cut;
}

ImU32 state_colour(haptics::GuardState state) {
  switch (state) {
    case haptics::GuardState::running:
      return ink::kGood;
    case haptics::GuardState::armed:
    case haptics::GuardState::ramping:
      return ink::kAccent;
    case haptics::GuardState::damped:
      return ink::kWarn;
    case haptics::GuardState::released:
      return ink::kBad;
    case haptics::GuardState::idle:
      return ink::kSoft;
  }
  return ink::kSoft;
}

const char* state_label(haptics::GuardState state) {
  static constexpr const char* kLabels[] = {"off", "starting", "starting", "on", "damped", "stopped"};
  return kLabels[static_cast<int>(state)];
}

void draw_state(const BarCursor& parts, float width, const haptics::HapticSnapshot& now) {
  const ImU32 colour = state_colour(now.guard);
  const bool has_fault = (now.guard == haptics::GuardState::damped || now.guard == haptics::GuardState::released) &&
                         now.fault != haptics::GuardFault::none;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = parts.low(), high(low.x + width, low.y + parts.height());
  list.AddRectFilled(low, high, engine::with_alpha(colour, 0.16f), 4.0f);
  list.AddRect(low, high, engine::with_alpha(colour, 0.7f), 4.0f);
  const auto centred = [&](engine::UiFont which, const char* text, float y, ImU32 shade) {
    ImFont* font = engine::ui_font(which);
    const float text_width = font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, text).x;
    list.AddText(font, engine::ui_font_size(font), {low.x + 0.5f * (width - text_width), y}, shade, text);
  };
  const float title = engine::ui_font_size(engine::UiFont::title), small = engine::ui_font_size(engine::UiFont::small);
  const float top = low.y + 0.5f * (parts.height() - title - (has_fault ? small : 0.0f));
  centred(engine::UiFont::title, state_label(now.guard), top, colour);
  if (has_fault) centred(engine::UiFont::small, haptics::to_string(now.fault), top + title, ink::kText);
}

void draw_force_switch(Controls& controls, const BarCursor& parts, float width, const PanelInput& input,
                       PanelCommands& out) {
  const haptics::GuardState state = input.now.guard;
  const bool off = state == haptics::GuardState::idle || state == haptics::GuardState::damped ||
                   state == haptics::GuardState::released;
  const ImVec2 size(width, parts.height());
  if (off) {
    ImGui::BeginDisabled(input.stick && !input.stick->plugged_in);
    if (controls.button("arm", "Forces on", size, ink::kAccentDeep)) out.push_back(Arm{});
    ImGui::EndDisabled();
  } else {
    if (controls.button("disarm", "Forces off", size)) out.push_back(Disarm{});
  }
}

// The button cannot end a lesson's recording, because that recording ends with the lesson.
void draw_recording(Controls& controls, const BarCursor& parts, float width, const PanelInput& input,
                    PanelCommands& out) {
  const float gap = 0.25f * engine::ui_em();
  const ImVec2 size(width, 0.5f * (parts.height() - gap));
  const bool of_lesson = input.recording && input.coach.phase == lessons::LessonPhase::driving;
  if (of_lesson) {
    const engine::WithFont small(engine::UiFont::small);
    ImGui::BeginDisabled();
    controls.button("record", "Recording lesson", size);
    ImGui::EndDisabled();
  } else {
    const bool pressed = input.recording ? controls.button("record", "End recording", size, ink::kBadDeep)
                                         : controls.button("record", "Record", size);
    if (pressed) out.push_back(ToggleRecording{});
  }
  ImGui::SetCursorScreenPos({parts.low().x, parts.low().y + size.y + gap});
  if (controls.button("replay", "Replay", size)) out.push_back(ReplayLastRecording{});
}

// Stops on mouse-down, because the release is lost if the pointer leaves the button first.
void draw_stop(Controls& controls, const BarCursor& parts, float width, PanelCommands& out) {
  const engine::WithFont large(engine::UiFont::digits);
  controls.button("stop", "STOP", {width, parts.height()}, ink::kBadDeep);
  if (ImGui::IsItemActivated()) out.push_back(Stop{});
}

// The parts of the bar that fit in its width; the least important ones are left out first.
struct BarLayout {
  bool state, arm, car, recording;
  int lamps;      // number of lamp columns
  float message;  // [em] width of the message; 0: no message
};

BarLayout fit_layout(float room, float first_lamp_width) {
  const auto fits = [&room](float width) {
    const bool has_room = room >= width + 1.0f;
    if (has_room) room -= width + 1.0f;
    return has_room;
  };
  BarLayout shown{};
  room -= kStop;
  shown.arm = fits(kArm);
  shown.state = fits(kState);
  shown.car = fits(kCar);
  shown.recording = fits(kRecording);
  if (fits(first_lamp_width)) shown.lamps = 1;
  while (shown.lamps > 0 && shown.lamps < kLampColumns && fits(kLamps - 1.0f)) ++shown.lamps;
  if (room >= kMinMessageWidth + 1.0f) shown.message = room - 1.0f;
  return shown;
}

}  // namespace

bool draw_control_bar(Controls& controls, const PanelInput& input, PanelCommands& out) {
  const float em = engine::ui_em(), all = ImGui::GetContentRegionAvail().x;
  const float stop = std::min(kStop * em, all), right_group = ImGui::GetCursorScreenPos().x + all;
  const BarLayout shown = fit_layout(all / em, first_lamp_width(input));
  BarCursor parts;
  if (shown.car) {
    draw_car(parts, input);
    parts.next(kCar * em);
  }
  if (shown.lamps > 0) {
    draw_lamps(parts, shown.lamps, input);
    parts.next((first_lamp_width(input) + static_cast<float>(shown.lamps - 1) * kLamps) * em);
  }
  const bool message_fits = shown.message > 0.0f && draw_message(controls, parts, shown.message * em, input);
  const float group = (shown.state ? kState + 1.0f : 0.0f) + (shown.arm ? kArm + 1.0f : 0.0f) +
                      (shown.recording ? kRecording + 1.0f : 0.0f);
  parts.go_to(right_group - stop - group * em);
  if (shown.state) {
    draw_state(parts, kState * em, input.now);
    parts.next(kState * em);
  }
  if (shown.arm) {
    draw_force_switch(controls, parts, kArm * em, input, out);
    parts.next(kArm * em);
  }
  if (shown.recording) {
    draw_recording(controls, parts, kRecording * em, input, out);
    parts.next(kRecording * em);
  }
  draw_stop(controls, parts, stop, out);
  return message_fits;
}

}  // namespace gearshift::ui
