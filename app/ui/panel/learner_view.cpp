#include "app/ui/panel/learner_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/ui/panel/car_strip.h"
#include "app/ui/panel/gate_view.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

// [em] Heights of the instruments and of the buttons, and widths of their parts.
constexpr float kInstrumentRow = 7.6f, kButtonRow = 4.4f, kGateWidth = 7.4f, kPedalWidth = 2.4f, kCarWidth = 9.0f,
                kButtonWidth = 6.0f, kStopWidth = 9.0f, kPartGap = 0.6f;
constexpr float kInstrumentsWidth = kGateWidth + 3.0f * kPedalWidth + kCarWidth + 4.0f * kPartGap;
constexpr float kButtonsWidth = 3.0f * kButtonWidth + kStopWidth + 3.0f * kPartGap;

float strip_padding() {
  return 2.0f * ImGui::GetStyle().WindowPadding.x;
}

bool is_one_row(float width) {
  return width - strip_padding() >= (kInstrumentsWidth + kPartGap + kButtonsWidth) * engine::ui_em();
}

// An invisible control shows by itself that it has the keyboard.
void draw_focus() {
  if (!ImGui::IsItemFocused()) return;
  ImGui::GetForegroundDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ink::kAccent, 3.0f, 0,
                                          2.0f);
}

struct PedalLook {
  const char* control;  // name in Panel::control_rect()
  const char* label;
  double haptics::Pedals::*pedal;
  ImU32 colour;
};
constexpr PedalLook kPedals[] = {{"pedal_clutch", "clutch", &haptics::Pedals::clutch, ink::kAccent},
                                 {"pedal_brake", "brake", &haptics::Pedals::brake, ink::kBad},
                                 {"pedal_throttle", "gas", &haptics::Pedals::throttle, ink::kGood}};

// A pedal seen from the side of its travel: what is pressed fills the bar from the top, because down is pressed.
void draw_pedal(const PedalLook& look, const PanelInput& input, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = engine::ui_em(), left = low.x + 0.45f * em, right = high.x - 0.45f * em;
  const auto y = [&](double at) { return low.y + static_cast<float>(std::clamp(at, 0.0, 1.0)) * (high.y - low.y); };
  const double pressed = input.car.pedals.*look.pedal;
  list.AddRectFilled({left, low.y}, {right, high.y}, ink::kWell, 2.0f);
  list.AddRectFilled({left, low.y}, {right, y(pressed)}, look.colour, 2.0f);
  const bool is_clutch = look.pedal == &haptics::Pedals::clutch;
  if (is_clutch && input.car.clutch_bite > input.car.clutch_closed) {
    const ImVec2 from(left, y(input.car.clutch_closed)), to(right, y(input.car.clutch_bite));
    list.AddRectFilled(from, to, ink::kBiteZone);
    list.AddRect(from, to, ink::kBiteMark, 0.0f, 0, input.coach.pedal_help > 0.0 ? 3.0f : 1.0f);
  }
  if (look.pedal == &haptics::Pedals::throttle && input.held_throttle > 0.0)
    list.AddLine({left, y(input.held_throttle)}, {right, y(input.held_throttle)}, ink::kText, 0.15f * em);
  if (const WantedRange wanted = wanted_range(input, look.pedal); wanted.is_set()) {
    const float x = right + 0.12f * em;
    list.AddLine({x, y(wanted.from)}, {x, y(wanted.to)}, ink::kIdeal, 0.22f * em);
    const float middle = y(std::clamp(pressed, wanted.from, wanted.to));
    list.AddTriangleFilled({x - 0.1f * em, middle}, {x + 0.5f * em, middle - 0.35f * em},
                           {x + 0.5f * em, middle + 0.35f * em}, ink::kIdeal);
  }
  list.AddRect({left, low.y}, {right, high.y}, ink::kWall, 2.0f);
}

void draw_pedals(Controls& controls, const PanelInput& input, ImVec2 at, float height, PanelCommands& out) {
  const float em = engine::ui_em(), label = engine::ui_font_size(engine::UiFont::small);
  for (const PedalLook& look : kPedals) {
    const ImVec2 low(at.x, at.y), high(at.x + kPedalWidth * em, at.y + height - label - 0.2f * em);
    ImGui::SetCursorScreenPos(low);
    ImGui::InvisibleButton(look.control, {high.x - low.x, high.y - low.y});
    controls.mark(look.control);
    draw_focus();
    if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left))
      out.push_back(DriveCommand(MovePedal{
          look.pedal, std::clamp(static_cast<double>((ImGui::GetMousePos().y - low.y) / (high.y - low.y)), 0.0, 1.0)}));
    draw_pedal(look, input, low, high);
    const engine::WithFont small(engine::UiFont::small);
    const float width = width_of(look.label);
    ImGui::GetWindowDrawList()->AddText({at.x + 0.5f * (kPedalWidth * em - width), high.y + 0.1f * em}, ink::kText,
                                        look.label);
    at.x += (kPedalWidth + 0.3f) * em;
  }
}

// Engine speed as a bar: where to shift up, and the red line.
void draw_engine_bar(const PanelInput& input, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ink::kWell, 2.0f);
  if (input.engine == nullptr) return;
  const double end = 1.1 * input.engine->red_line;
  const auto x = [&](double speed) {
    return low.x + static_cast<float>(std::clamp(speed / end, 0.0, 1.0)) * (high.x - low.x);
  };
  list.AddRectFilled({x(input.engine->shift_low), low.y}, {x(input.engine->shift_high), high.y},
                     engine::with_alpha(ink::kGood, 0.45f));
  list.AddRectFilled({x(input.engine->red_line), low.y}, high, ink::kBadDeep);
  const float now = x(std::abs(input.car.engine_speed));
  list.AddRectFilled({low.x, low.y + 0.3f * (high.y - low.y)}, {now, high.y - 0.3f * (high.y - low.y)}, ink::kEngine);
  list.AddLine({now, low.y}, {now, high.y}, ink::kText, 2.0f);
}

void draw_car(const PanelInput& input, ImVec2 low, float height) {
  const float em = engine::ui_em(), gear_width = 3.0f * em, x = low.x + gear_width + 0.3f * em;
  const vehicle::VehicleState& car = input.car;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* const digits = engine::ui_font(engine::UiFont::digits);
  const char* const gear = haptics::gear_name(input.now.gear);
  const float width = digits->CalcTextSizeA(engine::ui_font_size(digits), 1e9f, 0.0f, gear).x;
  list.AddText(digits, engine::ui_font_size(digits), {low.x + 0.5f * (gear_width - width), low.y + 0.6f * em},
               car.grinding ? ink::kBad : ink::kText, gear);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  list.AddText({x, low.y + 0.2f * em}, ink::kText, format_speed(car).c_str());
  list.AddText({x, low.y + 0.2f * em + line}, car.stalled || car.over_revved ? ink::kBad : ink::kText,
               (car.stalled ? std::string("stalled") : format_rpm(std::abs(car.engine_speed))).c_str());
  const float bar = low.y + 0.4f * em + 2.0f * line;
  draw_engine_bar(input, {low.x, bar}, {low.x + kCarWidth * em, bar + 0.8f * em});
  const engine::WithFont small(engine::UiFont::small);
  std::string words = car.shift_advice > 0 ? "shift up" : car.shift_advice < 0 ? "shift down" : "";
  if (car.clutch_smells) words = "clutch too hot";
  if (const double slope = slope_percent(car); words.empty() && slope != 0.0)
    words = fmt::format("{:.0f} % {}", std::abs(slope), slope > 0.0 ? "uphill" : "downhill");
  const float foot = low.y + height - ImGui::GetFontSize();
  list.AddText({low.x, foot}, ink::kWarn, words.c_str());
}

void draw_gate(Controls& controls, const PanelInput& input, const haptics::GateDescription& gate, ImVec2 low,
               ImVec2 size, PanelCommands& out) {
  static const Trail kNoTrail;
  ImGui::SetCursorScreenPos(low);
  if (ImGui::InvisibleButton("gate", size))
    if (const auto gear = gear_at(input.gate, gate, ImGui::GetMousePos())) out.push_back(DriveCommand(ShiftTo{*gear}));
  controls.mark("gate");
  draw_focus();
  ImGui::SetCursorScreenPos(low);
  draw_gate_view(size, input.gate, gate, input.now, kNoTrail, 0.0, {{}, input.way, input.wanted_gear});
}

// A switch of the car; lit while it is on.
bool draw_switch(Controls& controls, const char* name, const char* label, ImVec2 size, bool on, ImU32 colour) {
  const engine::WithFont small(engine::UiFont::small);
  return controls.button(name, label, size, on ? colour : ink::kRaised);
}

LearnerChoice draw_buttons(Controls& controls, const PanelInput& input, ImVec2 low, float height, bool lists_lessons,
                           PanelCommands& out) {
  const float em = engine::ui_em(), gap = 0.3f * em;
  const ImVec2 size(kButtonWidth * em, 0.5f * (height - gap));
  const auto place = [&](int column, int row) {
    ImGui::SetCursorScreenPos(
        {low.x + static_cast<float>(column) * (size.x + gap), low.y + static_cast<float>(row) * (size.y + gap)});
  };
  LearnerChoice chosen;
  const bool has_hand_brake = input.car.pedals.hand_brake > kHandBrakeOn;
  place(0, 0);
  if (draw_switch(controls, "hand_brake", "Handbrake", size, has_hand_brake, ink::kBadDeep))
    out.push_back(DriveCommand(Press{Action::hand_brake}));
  place(1, 0);
  if (draw_switch(controls, "ignition", "Ignition", size, input.car.ignition, ink::kAccentDeep))
    out.push_back(DriveCommand(Press{Action::ignition}));
  place(2, 0);
  (void)draw_switch(controls, "starter", "Starter", size, input.car.cranking, ink::kAccentDeep);
  if (ImGui::IsItemActive() || ImGui::IsItemDeactivated())
    out.push_back(DriveCommand(HoldStarter{ImGui::IsItemActive()}));
  place(0, 1);
  chosen.lessons = draw_switch(controls, "lessons", "Lessons (L)", size, lists_lessons, ink::kAccentDeep);
  place(1, 1);
  chosen.engineer = draw_switch(controls, "view", "More (F2)", size, false, ink::kRaised);
  place(2, 1);
  const haptics::GuardState guard = input.now.guard;
  const bool off = guard == haptics::GuardState::idle || guard == haptics::GuardState::damped ||
                   guard == haptics::GuardState::released;
  const engine::WithFont small(engine::UiFont::small);
  ImGui::BeginDisabled(off && input.stick && !input.stick->plugged_in);
  if (controls.button(off ? "arm" : "disarm", off ? "Forces on" : "Forces off", size,
                      off ? ink::kAccentDeep : ink::kRaised)) {
    if (off)
      out.push_back(Arm{});
    else
      out.push_back(Disarm{});
  }
  ImGui::EndDisabled();
  return chosen;
}

// Acts on mouse-down, as the bar's.
void draw_stop(Controls& controls, ImVec2 low, ImVec2 size, PanelCommands& out) {
  const engine::WithFont large(engine::UiFont::digits);
  ImGui::SetCursorScreenPos(low);
  controls.button("stop", "STOP", size, ink::kBadDeep);
  if (ImGui::IsItemActivated()) out.push_back(Stop{});
}

}  // namespace

WantedRange wanted_range(const PanelInput& input, double haptics::Pedals::*pedal) {
  if (input.wanted == nullptr) return {};
  const lessons::DriveCondition& wanted = *input.wanted;
  const auto range = [](const std::optional<double>& above, const std::optional<double>& below) {
    return above || below ? WantedRange{above.value_or(0.0), below.value_or(1.0)} : WantedRange{};
  };
  if (pedal == &haptics::Pedals::clutch && (wanted.clutch_holds_car || wanted.clutch_torque_above))
    return {input.car.clutch_closed, input.car.clutch_bite};
  if (pedal == &haptics::Pedals::clutch && !wanted.clutch_above && !wanted.clutch_below && !input.way.empty())
    return {input.car.clutch_bite, 1.0};  // to shift
  if (pedal == &haptics::Pedals::clutch) return range(wanted.clutch_above, wanted.clutch_below);
  if (pedal == &haptics::Pedals::brake) return range(wanted.brake_above, wanted.brake_below);
  return range(wanted.throttle_above, wanted.throttle_below);
}

float learner_strip_height(ImVec2 screen) {
  const float rows = is_one_row(screen.x) ? kInstrumentRow : kInstrumentRow + kPartGap + kButtonRow;
  return std::min(rows * engine::ui_em() + 2.0f * ImGui::GetStyle().WindowPadding.y, 0.6f * screen.y);
}

LearnerChoice draw_learner_strip(Controls& controls, const PanelInput& input, const haptics::GateDescription& gate,
                                 bool lists_lessons, PanelCommands& out) {
  const float em = engine::ui_em(), room = ImGui::GetContentRegionAvail().x;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const bool one_row = is_one_row(ImGui::GetWindowWidth());
  const float height = kInstrumentRow * em;
  draw_gate(controls, input, gate, low, {kGateWidth * em, height}, out);
  float x = low.x + (kGateWidth + kPartGap) * em;
  draw_pedals(controls, input, {x, low.y}, height, out);
  x += (3.0f * kPedalWidth + 2.0f * kPartGap) * em;
  draw_car(input, {x, low.y}, height);
  const float top = one_row ? low.y + 0.5f * (height - kButtonRow * em) : low.y + height + kPartGap * em;
  const float stop = std::min(kStopWidth * em, room);
  const ImVec2 right(low.x + room - stop, top);
  draw_stop(controls, right, {stop, kButtonRow * em}, out);
  const float grid = 3.0f * kButtonWidth * em + 0.6f * em;
  if (room < grid + stop + kPartGap * em) return {};
  return draw_buttons(controls, input, {right.x - kPartGap * em - grid, top}, kButtonRow * em, lists_lessons, out);
}

}  // namespace gearshift::ui
