#include "app/ui/panel/controls_card.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/ui/panel/bottom_window.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/gate/aisle.h"

namespace gearshift::ui {
namespace {

constexpr float kCardWidth = 44.0f, kPictureSize = 7.0f, kLampSize = 0.75f;  // [em]
constexpr float kMaxListHeight = 13.0f;                                      // [em]
constexpr float kMaxPedalAngle = 0.6f;                                       // [rad] drawn travel of a pedal

// Where the axis is between its first value (0) and its end in this step (1).
float travel_of(const AxisDetector::MovingAxis& axis) {
  const double end = axis.high - axis.rest > axis.rest - axis.low ? axis.high : axis.low;
  return end == axis.rest ? 0.0f : static_cast<float>(std::clamp((axis.now - axis.rest) / (end - axis.rest), 0.0, 1.0));
}

// A pedal or handbrake from the side: an arm that turns about its end.
void draw_pedal(ImVec2 low, float size, float travel) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = engine::ui_em(), angle = 0.35f + kMaxPedalAngle * travel;
  const ImVec2 pivot(low.x + 0.75f * size, low.y + 0.15f * size);
  const ImVec2 along(-std::cos(angle), std::sin(angle)), across(std::sin(angle), std::cos(angle));
  const ImVec2 pad(pivot.x + 0.65f * size * along.x, pivot.y + 0.65f * size * along.y);
  list.AddLine(pivot, pad, ink::kWall, 0.3f * em);
  list.AddCircleFilled(pivot, 0.3f * em, ink::kWall);
  const float half = 0.16f * size;
  list.AddLine({pad.x - half * across.x, pad.y - half * across.y}, {pad.x + half * across.x, pad.y + half * across.y},
               travel > 0.02f ? ink::kAccent : ink::kSoft, 0.55f * em);
}

// A lever from above, between its two ends.
void draw_lever(ImVec2 low, float size, bool is_sideways, const std::optional<AxisDetector::MovingAxis>& axis) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = engine::ui_em(), half = 0.38f * size;
  const ImVec2 middle(low.x + 0.5f * size, low.y + 0.5f * size);
  const auto at = [&](float place) {
    return is_sideways ? ImVec2(middle.x + half * place, middle.y) : ImVec2(middle.x, middle.y - half * place);
  };
  list.AddLine(at(-1.0f), at(1.0f), ink::kFree, 1.2f * em);
  const bool moves = axis && axis->high > axis->low;
  const double place = moves ? 2.0 * (axis->now - axis->low) / (axis->high - axis->low) - 1.0 : 0.0;
  list.AddCircleFilled(at(static_cast<float>(place)), 0.9f * em, moves ? ink::kAccent : ink::kSoft);
}

// The shifter's pattern with the gear that is asked for.
void draw_gears(ImVec2 low, float size, const haptics::Gate& gate, int asked) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = engine::ui_em();
  const bool has_aisles = haptics::is_mechanism(gate);
  const double left = has_aisles ? -haptics::half_extent(gate).x : gate.select_min;
  const double width = has_aisles ? -2.0 * left : std::max(gate.select_max - gate.select_min, 1e-3);
  double depth = has_aisles ? haptics::half_extent(gate).y : 1e-3;
  for (const haptics::Slot& slot : haptics::slots(gate)) depth = std::max(depth, slot.rest);
  const auto at = [&](glm::dvec2 p) {
    return ImVec2(low.x + size * static_cast<float>(0.1 + 0.8 * (p.x - left) / width),
                  low.y + size * static_cast<float>(0.5 - 0.32 * p.y / depth));
  };
  const ImU32 line = ink::kWall;
  if (!has_aisles) list.AddLine(at({gate.select_min, 0.0}), at({gate.select_max, 0.0}), line, 0.2f * em);
  for (const haptics::Aisle& aisle : haptics::aisles(gate)) list.AddLine(at(aisle.from), at(aisle.to), line, 0.2f * em);
  const auto mark = [&](int gear) {
    const ImVec2 place = at(haptics::rest_position(gate, gear));
    const bool is_asked = gear == asked;
    list.AddCircleFilled(place, 0.75f * em, is_asked ? ink::kAccent : ink::kPlate);
    const char* name = haptics::gear_label(gate, gear);
    const ImVec2 text = ImGui::CalcTextSize(name);
    list.AddText({place.x - 0.5f * text.x, place.y - 0.5f * text.y}, is_asked ? ink::kFree : ink::kSoft, name);
  };
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    const glm::dvec2 rest = haptics::rest_position(gate, slot.gear);
    if (!has_aisles) list.AddLine(at({rest.x, 0.0}), at(rest), line, 0.2f * em);
  }
  for (const haptics::Slot& slot : haptics::slots(gate)) mark(slot.gear);
  mark(haptics::kNeutralGear);
}

void draw_picture(const ControlsSetup& setup, const haptics::Gate& gate) {
  const float size = kPictureSize * engine::ui_em();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size, low.y + size}, ink::kWell, 0.4f * engine::ui_em());
  const std::optional<AxisDetector::MovingAxis> moving = setup.moving();
  if (const AxisInfo* axis = setup.axis(); axis != nullptr && axis->is_lever)
    draw_lever(low, size, axis->axis == &Bindings::lever_select, moving);
  else if (axis != nullptr)
    draw_pedal(low, size, moving ? travel_of(*moving) : 0.0f);
  else
    draw_gears(low, size, gate, setup.gear().value_or(haptics::kNeutralGear));
  ImGui::Dummy({size, size});
}

// A bar per axis and a lamp per button.
void draw_controller(const engine::Controller& one) {
  const float em = engine::ui_em();
  put(one.name, ink::kSoft, engine::UiFont::small);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImVec2 at = ImGui::GetCursorScreenPos();
  const float left = at.x, bar = 3.0f * em;
  const auto place = [&](float width) {
    if (at.x + width > right && at.x > left) at = {left, at.y + 1.1f * em};
    const ImVec2 here = at;
    at.x += width + 0.35f * em;
    return here;
  };
  for (const float value : one.axes) {
    const ImVec2 low = place(bar);
    const float middle = low.x + 0.5f * bar * (1.0f + std::clamp(value, -1.0f, 1.0f));
    list.AddRectFilled(low, {low.x + bar, low.y + 0.6f * em}, ink::kWell);
    list.AddRectFilled({middle - 0.12f * em, low.y}, {middle + 0.12f * em, low.y + 0.6f * em}, ink::kAccent);
  }
  for (const unsigned char button : one.buttons) {
    const ImVec2 low = place(kLampSize * em);
    list.AddRectFilled(low, {low.x + kLampSize * em, low.y + 0.6f * em}, button != 0 ? ink::kGood : ink::kWell,
                       0.2f * em);
  }
  ImGui::Dummy({right - left, at.y + 0.8f * em - ImGui::GetCursorScreenPos().y});
}

// Name of each choice's button in Controls.
const char* name_of(ControlsSetup::Answer answer) {
  constexpr std::array kNames{"setup_done",    "setup_skip",  "setup_back",  "setup_gears",
                              "setup_paddles", "setup_lever", "setup_other", "setup_stays",
                              "setup_returns", "setup_steps", "setup_held",  "setup_toggled"};
  static_assert(kNames.size() == static_cast<std::size_t>(ControlsSetup::Answer::toggled) + 1);
  return kNames[static_cast<std::size_t>(answer)];
}

void draw_choices(Controls& controls, const ControlsSetup& setup, PanelCommands& out) {
  bool is_first = true;
  const auto is_clicked = [&](const char* name, const std::string& label, ImU32 colour) {
    if (!std::exchange(is_first, false)) same_line_if_fits(button_width(label));
    return controls.button(name, label.c_str(), {0.0f, 0.0f}, colour);
  };
  if (setup.is_over() && is_clicked("setup_save", "Save (Enter)", ink::kPrimary)) out.push_back(SaveControls{});
  if (!setup.is_resting())
    for (const ControlsSetup::Choice& choice : setup.choices()) {
      const bool is_done = choice.answer == ControlsSetup::Answer::done;
      const std::string label = is_done ? fmt::format("{} (Enter)", choice.label) : choice.label;
      if (is_clicked(name_of(choice.answer), label, is_done ? ink::kPrimary : ink::kRaised))
        out.push_back(AnswerControls{choice.answer});
    }
  if (is_clicked("setup_cancel", "Cancel (Esc)", ink::kRaised)) out.push_back(CancelControls{});
  const std::string if_skipped = setup.is_resting() ? std::string() : setup.if_skipped();
  if (!if_skipped.empty()) put_wrapped(fmt::format("Skip: {}.", if_skipped), ink::kSoft, engine::UiFont::small);
}

// `height` [px]: room for the whole card.
void draw_step(Controls& controls, const PanelInput& input, float height, PanelCommands& out) {
  const ControlsSetup& setup = *input.controls.setup;
  put(setup.is_over() ? "Set up controls"
                      : fmt::format("Set up controls: step {} of {}", setup.step() + 1, setup.steps()),
      ink::kSoft, engine::UiFont::small);
  put_wrapped(setup.prompt(), ink::kText, engine::UiFont::title);
  if (!setup.note().empty()) put_wrapped(setup.note(), ink::kSoft, engine::UiFont::body);
  // The answers come first, so that they are visible in a low window; what does not fit below them is scrolled or left out.
  draw_choices(controls, setup, out);
  const float em = engine::ui_em();
  const float left = height - (ImGui::GetCursorPosY() + ImGui::GetStyle().WindowPadding.y);
  if (left < kPictureSize * em) return;
  draw_picture(setup, input.gate);
  ImGui::SameLine();
  if (ImGui::BeginChild("controllers", {0.0f, std::min(left, kMaxListHeight * em)}))
    for (const engine::Controller& one : input.controls.controllers) draw_controller(one);
  ImGui::EndChild();
}

void draw_offer(Controls& controls, std::span<const std::string> names, PanelCommands& out) {
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  const bool is_one = names.size() == 1;
  put_wrapped(is_one ? fmt::format("{} was found. It has no effect until you set it up.", list)
                     : fmt::format("{} were found. They have no effect until you set them up.", list),
              ink::kText, engine::UiFont::body);
  if (controls.button("setup_begin", is_one ? "Set it up (about a minute)" : "Set them up (a few minutes)",
                      {0.0f, 0.0f}, ink::kPrimary))
    out.push_back(StartControls{});
  same_line_if_fits(button_width("Not now"));
  if (controls.button("setup_decline", "Not now")) out.push_back(DeclineControls{});
}

}  // namespace

double draw_controls_card(Controls& controls, const PanelInput& input, const ControlRect& room, PanelCommands& out) {
  const ControlsView& view = input.controls;
  if (view.setup == nullptr && view.offers.empty()) return room.max.y;
  const float width = bottom_width(room, kCardWidth);
  ImGui::SetNextWindowSize({width, 0.0f});
  double top = room.max.y;
  if (begin_at_bottom("Controls", room, ImGuiWindowFlags_AlwaysAutoResize)) {
    if (view.setup != nullptr)
      draw_step(controls, input, static_cast<float>(room.max.y - room.min.y) - kBottomMargin * engine::ui_em(), out);
    else
      draw_offer(controls, view.offers, out);
    top = static_cast<double>(ImGui::GetWindowPos().y);
  }
  ImGui::End();
  return std::clamp(top, room.min.y, room.max.y);
}

}  // namespace gearshift::ui
